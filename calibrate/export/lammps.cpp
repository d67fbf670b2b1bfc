#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "calibrate/export/conversions.h"
#include "calibrate/export/target_entry.h"
#include "dem/contact/restitution.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"

namespace repose::calibrate {
namespace {

/// Damping of the rolling spring, as in `elastic_plastic` (dem/THEORY.md): a fraction of critical.
constexpr double kRollingDamping = .3;

ExportedFile lammps_material_file(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Experiment any = facts.experiments().front();
  const dem::ContactTable contacts = facts.contacts(any);
  const dem::ContactLaw& wall = contacts.law(dem::kGrainMaterial, dem::kWallMaterial);
  DeckFields fields = common_fields(facts);
  fields.set("SKIN", .2 * facts.grain().reach_m());
  fields.set("K_NORMAL", 4.0 / 3 * wall.reduced_young_pa / facts.stiffness(any));
  fields.set("K_TANGENTIAL", 8 * wall.reduced_shear_pa / facts.stiffness(any));
  // LAMMPS multiplies the normal damper by it; ours scales with sqrt(S_t m*), S_t / S_n = 4 G* /
  // E*.
  fields.set("TANGENTIAL_DAMPING", std::sqrt(4 * wall.reduced_shear_pa / wall.reduced_young_pa));
  fields.set("WALL_RESTITUTION", exported(conversions, "contact.particle_wall.restitution"));
  fields.set("WALL_SLIDING", exported(conversions, "contact.particle_wall.sliding_friction"));
  fields.set("WALL_ROLLING", exported(conversions, "contact.particle_wall.rolling_friction"));
  return {.name = "material.lmp", .text = filled("lammps/material.lmp", fields)};
}

/// Of the rolling spring, N/m, and its damper, N s/m.
struct RollingSpring {
  double spring = 0;
  double damper = 0;
};

RollingSpring rolling_spring(const ExportFacts& facts, const dem::ContactLaw& law) {
  const double radius = facts.grain().spheres.front().radius;
  const double mass = facts.mass_kg();
  const double spring = rolling_stiffness(law, mass, radius) / (radius * radius);
  return {spring, 2 * kRollingDamping * std::sqrt(1.4 * mass * spring)};
}

DeckFields lammps_fields(const ExportFacts& facts, dem::Experiment experiment, bool is_sphere) {
  const dem::ContactTable contacts = facts.contacts(experiment);
  const RollingSpring roll =
      rolling_spring(facts, contacts.law(dem::kGrainMaterial, dem::kWallMaterial));
  DeckFields fields = common_fields(facts);
  if (!is_sphere) fields.add_section("CLUMP");
  fields.set("STIFFNESS", facts.stiffness(experiment));
  fields.set("TIMESTEP", facts.timestep_s(experiment));
  fields.set("REACH", 2 * facts.grain().reach_m());
  fields.set("K_ROLL", roll.spring);
  fields.set("GAMMA_ROLL", roll.damper);
  return fields;
}

/// Mass, centre and moments of inertia about the world's axes, as `fix rigid infile` reads them.
ExportedFile inertia_file(const std::string& name, const dem::ClumpShape& shape, double mass_kg,
                          const dem::Grain& grain) {
  const Eigen::Matrix3d turn = grain.orientation.toRotationMatrix();
  const Eigen::Matrix3d inertia =
      turn * (mass_kg * shape.gyration_m2).asDiagonal() * turn.transpose();
  const dem::Vector& at = grain.position;
  const dem::Vector& speed = grain.velocity;
  return {.name = name,
          .text = fmt::format("1\n1 {} {} {} {} {} {} {} {} {} {} {} {} {} 0 0 0 0 0 0\n", mass_kg,
                              at.x(), at.y(), at.z(), inertia(0, 0), inertia(1, 1), inertia(2, 2),
                              inertia(0, 1), inertia(0, 2), inertia(1, 2), speed.x(), speed.y(),
                              speed.z())};
}

/// The body's spheres in position, and for a clump its mass and inertia.
void add_body(const std::string& name, const dem::ClumpShape& shape, double mass_kg,
              const dem::Grain& grain, std::vector<ExportedFile>& files) {
  const bool is_sphere = shape.spheres.size() == 1;
  DeckFields fields;
  fields.add_section(is_sphere ? "SPHERE" : "CLUMP");
  fields.set("INFILE", name + ".txt");
  fields.set("VZ", grain.velocity.z());
  // It only gives the mass of single spheres.
  const double density = mass_kg / dem::sphere_shape(shape.spheres.front().radius).volume_m3;
  int count = 0;
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    const dem::Vector at = grain.position + grain.orientation * sphere.centre;
    DeckFields& ball = fields.add_section("BALL");
    ball.set("NUMBER", ++count);
    ball.set("X", at.x());
    ball.set("Y", at.y());
    ball.set("Z", at.z());
    ball.set("DIAMETER", 2 * sphere.radius);
    ball.set("DENSITY", density);
  }
  files.push_back({.name = name + ".lmp", .text = filled("lammps/body.lmp", fields)});
  if (!is_sphere) files.push_back(inertia_file(name + ".txt", shape, mass_kg, grain));
}

void add_drop(const ExportFacts& facts, std::vector<ExportedFile>& files) {
  const dem::DropProtocol& protocol = facts.study().protocol<dem::DropProtocol>();
  const double reach = facts.grain().reach_m();
  const double speed = facts.speed_m_s(dem::experiment_of<dem::DropProtocol>());
  DeckFields fields =
      lammps_fields(facts, dem::experiment_of<dem::DropProtocol>(), facts.is_sphere());
  fields.set("HEIGHT_MM", 1e3 * protocol.height_m);
  fields.set("GRAINS", protocol.grains);
  fields.set("ROOM", protocol.height_m + 10 * reach);
  fields.set("TOP", protocol.height_m + 10 * reach);
  fields.set("STEPS", steps(facts.longest_drop_s(dem::experiment_of<dem::DropProtocol>()),
                            facts.timestep_s(dem::experiment_of<dem::DropProtocol>())));
  int number = 0;
  for (const TouchingPose& pose : facts.drop_poses()) {
    fields.add_section("POSE").set("NUMBER", ++number);
    add_body(fmt::format("drop_grain_{}", number), facts.grain(), facts.mass_kg(),
             {.position = {0, 0, pose.height_m},
              .orientation = pose.orientation,
              .velocity = {0, 0, -speed}},
             files);
  }
  files.push_back({.name = "drop.lmp", .text = filled("lammps/drop.lmp", fields)});
}

void add_tilt(const ExportFacts& facts, std::vector<ExportedFile>& files) {
  const dem::TiltProtocol& protocol = facts.study().protocol<dem::TiltProtocol>();
  const dem::ClumpShape body = facts.tilt_body();
  const TouchingPose pose = facts.tilt_pose();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::TiltProtocol>());
  DeckFields fields =
      lammps_fields(facts, dem::experiment_of<dem::TiltProtocol>(), body.spheres.size() == 1);
  fields.set("BONDED", protocol.bonded);
  fields.set("RATE", protocol.rate_deg_s);
  fields.set("BEGIN", facts.tilt_begin_deg());
  fields.set("ROOM", 10 * body.reach_m());
  fields.set("SETTLE_STEPS", steps(.05, timestep));
  fields.set("EVERY", steps(.002, timestep));
  add_body("tilt_body", body, protocol.bonded * facts.mass_kg(),
           {.position = {0, 0, pose.height_m}, .orientation = pose.orientation}, files);
  files.push_back({.name = "tilt.lmp", .text = filled("lammps/tilt.lmp", fields)});
}

/// An incline of another material than the flat's has its own contact law.
void add_incline(const ExportFacts& facts, const Conversions& conversions, DeckFields& fields) {
  if (!facts.study().model.parts.contains(dem::WallPart::incline)) {
    fields.add_section("ONE_MATERIAL");
    return;
  }
  const dem::ContactLaw law =
      facts.law(dem::experiment_of<dem::RollProtocol>(), dem::WallPart::incline);
  const double stiffness = facts.stiffness(dem::experiment_of<dem::RollProtocol>());
  const RollingSpring roll = rolling_spring(facts, law);
  const std::string pair = "contact.particle_incline.";
  DeckFields& own = fields.add_section("TWO_MATERIALS");
  own.set("INCLINE_NAME", sanitized(facts.surface(dem::WallPart::incline).material.name));
  own.set("INCLINE_NORMAL", 4.0 / 3 * law.reduced_young_pa / stiffness);
  own.set("INCLINE_TANGENTIAL", 8 * law.reduced_shear_pa / stiffness);
  own.set("INCLINE_DAMPING", std::sqrt(4 * law.reduced_shear_pa / law.reduced_young_pa));
  own.set("INCLINE_RESTITUTION", exported(conversions, pair + "restitution"));
  own.set("INCLINE_SLIDING", exported(conversions, pair + "sliding_friction"));
  own.set("INCLINE_ROLLING", exported(conversions, pair + "rolling_friction"));
  own.set("INCLINE_K_ROLL", roll.spring);
  own.set("INCLINE_GAMMA_ROLL", roll.damper);
}

void add_roll(const ExportFacts& facts, const Conversions& conversions,
              std::vector<ExportedFile>& files) {
  const dem::RollProtocol& protocol = facts.study().protocol<dem::RollProtocol>();
  const dem::Vector normal = dem::incline_of(protocol).normal;
  const double reach = facts.grain().reach_m();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::RollProtocol>());
  DeckFields fields =
      lammps_fields(facts, dem::experiment_of<dem::RollProtocol>(), facts.is_sphere());
  fields.set("RELEASE_MM", 1e3 * protocol.release_m);
  fields.set("INCLINE", protocol.incline_deg);
  fields.set("NORMAL_X", normal.x());
  fields.set("NORMAL_Z", normal.z());
  fields.set("BEHIND", 2 * (protocol.release_m + 10 * reach));
  fields.set("FLAT", facts.roll_flat_m());
  fields.set("END", facts.roll_flat_m() - 2 * reach);  // there it would be lost
  fields.set("ROOM", protocol.release_m + 10 * reach);
  fields.set("TOP", 2 * (protocol.release_m + 10 * reach));
  fields.set("EVERY", steps(.1, timestep));
  fields.set("STEPS", steps(60, timestep));
  fields.set("REST", 1e-3 * reach);
  add_incline(facts, conversions, fields);
  add_body("roll_grain", facts.grain(), facts.mass_kg(), facts.roll_start(), files);
  files.push_back({.name = "roll.lmp", .text = filled("lammps/roll.lmp", fields)});
}

std::vector<ExportedFile> lammps_files(const ExportFacts& facts, const Conversions& conversions) {
  std::vector<ExportedFile> files = {lammps_material_file(facts, conversions)};
  if (facts.has(dem::experiment_of<dem::DropProtocol>())) add_drop(facts, files);
  if (facts.has(dem::experiment_of<dem::TiltProtocol>())) add_tilt(facts, files);
  if (facts.has(dem::experiment_of<dem::RollProtocol>())) add_roll(facts, conversions, files);
  return files;
}

/// The polynomial with which LAMMPS converts a restitution to the factor of its `damping tsuji`
/// (LAMMPS documentation, "pair_style granular", eq. for alpha); falls with `value` below 1.
double tsuji_polynomial(double value) {
  double sum = 0;
  for (const double term : {4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728}) {
    sum = sum * value + term;
  }
  return sum;
}

/// Inverts it by bisection, for values 0 to 6 (restitution from .01 up).
double tsuji_value(double factor) {
  double low = -1;
  double high = 1;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (low + high);
    (tsuji_polynomial(middle) > factor ? low : high) = middle;
  }
  return .5 * (low + high);
}

std::string lammps_program(dem::RollingModel /*model*/) {
  return "LAMMPS of 29 September 2021, with the packages GRANULAR and RIGID";
}

RestitutionCounterpart lammps_restitution(double ours) {
  return {
      .name = "damping tsuji",
      .value = tsuji_value(std::sqrt(1.5) * dem::textbook_damping_factor(ours)),
      .fidelity = Fidelity::exact,
      .law = "damper p(value) sqrt(2/3 S_n m*), p a polynomial of degree 6; it may pull",
      .limits =
          "The value is that for which p is the textbook factor times sqrt(3/2), and may be "
          "below 0. Spheres of a clump that land at once lose a different fraction of the speed "
          "from ours."};
}

std::string lammps_rolling_law(dem::RollingModel /*model*/) {
  return "rolling sds: spring, up to mu_r F R*, against the relative rotation, F without the "
         "damper's part";
}

RollingConversion lammps_rolling(dem::RollingModel model, Partner partner,
                                 const dem::ClumpShape& grain) {
  RollingConversion converted = to_relative_spin(model, partner, grain, 1);
  limit_to_fixed_spring(converted);
  return converted;
}

bool lammps_has_deck(const dem::Protocol& protocol) {
  return is_one_of<dem::DropProtocol, dem::TiltProtocol, dem::RollProtocol>(protocol);
}

}  // namespace

ExportTarget lammps_target() {
  static constexpr TargetEntry kTarget{.name = "lammps",
                                       .summary = "decks for drop, tilt and roll",
                                       .has_tables = false,
                                       .takes_incline_material = true,
                                       .program = lammps_program,
                                       .restitution = lammps_restitution,
                                       .heap_file = "heap.dump",
                                       .heap_unit = "m",
                                       .sliding_name = "last value of tangential mindlin_rescale",
                                       .sliding_limits = "",
                                       .rolling_name = "last value of rolling sds",
                                       .rolling_law = lammps_rolling_law,
                                       .rolling = lammps_rolling,
                                       .has_deck = lammps_has_deck,
                                       .files = lammps_files};
  return &kTarget;
}

}  // namespace repose::calibrate
