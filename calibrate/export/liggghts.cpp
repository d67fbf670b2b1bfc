#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/units.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/liggghts_decks.h"
#include "calibrate/export/stl.h"
#include "calibrate/export/target_entry.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"

namespace repose::calibrate {
namespace {

constexpr double kHard_pa = 1e9;
constexpr double kSoft_pa = 5e6;
constexpr int kTubeSides = 96;

void mark_stiffness(const ExportFacts& facts, DeckFields& fields) {
  const dem::Study& study = facts.study();
  double softest = HUGE_VAL;
  double hardest = 0;
  std::vector<const dem::Material*> materials = {&study.model.grain_material,
                                                 &study.model.wall_material};
  for (const dem::WallPart part : facts.parts()) materials.push_back(&facts.surface(part).material);
  for (const dem::Experiment experiment : facts.experiments()) {
    for (const dem::Material* material : materials) {
      const double young = material->young_modulus_pa * facts.stiffness(experiment);
      softest = std::min(softest, young);
      hardest = std::max(hardest, young);
    }
  }
  if (hardest > kHard_pa) fields.add_section("HARD");
  if (softest < kSoft_pa) fields.add_section("SOFT");
}

/// A row for each type: for the grain its values with all types, for walls the value with the
/// grain. Values between walls are never used.
std::string pairs_text(const std::vector<double>& with_grain) {
  std::string text;
  for (std::size_t a = 0; a < with_grain.size(); ++a) {
    for (std::size_t b = 0; b < with_grain.size(); ++b) {
      const std::size_t other = a == 0 || b == 0 ? a + b : 1;
      if (!text.empty()) text += ' ';
      text += number(with_grain[other]);
    }
  }
  return text;
}

std::string viscous_text(std::size_t pairs) {
  std::string text;
  for (std::size_t k = 0; k < pairs; ++k) {
    text += fmt::format("{}{:g}", k == 0 ? "" : " ", kLiggghtsRollingDamping);
  }
  return text;
}

void add_parts(const ExportFacts& facts, DeckFields& fields) {
  std::string young, poisson;
  for (const dem::WallPart part : facts.parts()) {
    const dem::Material& material = facts.surface(part).material;
    const std::string name = name_of(part);
    DeckFields& own = fields.add_section("PART");
    own.set("PART_NAME", name);
    own.set("PART_MATERIAL", sanitized(material.name));
    own.set("PART_TYPE", liggghts_type(facts, part));
    own.set("PART_YOUNG", material.young_modulus_pa);
    young += fmt::format(" ${{{}_young}}", name);
    poisson += ' ' + number(material.poisson_ratio);
  }
  fields.set("PARTS_YOUNG", young);
  fields.set("PARTS_POISSON", poisson);
}

ExportedFile material_file(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Study& study = facts.study();
  DeckFields fields = common_fields(facts);
  mark_stiffness(facts, fields);
  fields.set("SKIN", .2 * facts.grain().reach_m());
  fields.set("GRAIN_YOUNG", study.model.grain_material.young_modulus_pa);
  fields.set("WALL_YOUNG", study.model.wall_material.young_modulus_pa);
  fields.set("GRAIN_POISSON", study.model.grain_material.poisson_ratio);
  fields.set("WALL_POISSON", study.model.wall_material.poisson_ratio);
  add_parts(facts, fields);
  const std::size_t types = 2 + facts.parts().size();
  fields.set("TYPES", static_cast<int>(types));
  for (const auto& [field, name] : {std::pair("RESTITUTION", "restitution"),
                                    {"SLIDING", "sliding_friction"},
                                    {"ROLLING", "rolling_friction"}}) {
    const double wall = exported(conversions, fmt::format("contact.particle_wall.{}", name));
    // If grains never touch each other, they have no such coefficients.
    const double grain =
        facts.has_grain_contacts()
            ? exported(conversions, fmt::format("contact.particle_particle.{}", name))
            : wall;
    std::vector<double> with_grain = {grain, wall};
    for (const dem::WallPart part : facts.parts()) {
      with_grain.push_back(
          exported(conversions, fmt::format("contact.particle_{}.{}", name_of(part), name)));
    }
    fields.set(fmt::format("{}_PAIRS", field), pairs_text(with_grain));
  }
  fields.set("ROLLING_MODEL", liggghts_rolling_words(study.model.rolling));
  if (study.model.rolling == dem::RollingModel::elastic_plastic) {
    fields.add_section("VISCOUS").set("VISCOUS_PAIRS", viscous_text(types * types));
  }
  return {.name = "material.lig", .text = filled("liggghts/material.lig", fields)};
}

/// The grain template that is poured, or placed twice.
ExportedFile grain_file(const ExportFacts& facts) {
  DeckFields fields = common_fields(facts);
  mark_shape(facts.is_sphere(), fields);
  set_body(facts.grain(), facts.study().model.grain_material.density_kg_m3, fields);
  fields.set("RADIUS", facts.grain().spheres.front().radius);
  fields.set("DENSITY", density_kg_m3(facts, facts.is_sphere()));
  return {.name = "grain.lig", .text = filled("liggghts/grain.lig", fields)};
}

ExportedFile drop_on_wall_file(const ExportFacts& facts) {
  const dem::DropProtocol& protocol = facts.study().protocol<dem::DropProtocol>();
  return drop_file(facts, {.experiment = dem::experiment_of<dem::DropProtocol>(),
                           .ground = "a wall",
                           .section = "WALL",
                           .height_m = protocol.height_m,
                           .poses = facts.drop_poses()});
}

ExportedFile tilt_file(const ExportFacts& facts) {
  const dem::TiltProtocol& protocol = facts.study().protocol<dem::TiltProtocol>();
  const dem::ClumpShape body = facts.tilt_body();
  const TouchingPose pose = facts.tilt_pose();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::TiltProtocol>());
  const double begin = facts.tilt_begin_deg();
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::TiltProtocol>());
  set_body(body, facts.study().model.grain_material.density_kg_m3, fields);
  set_pose(pose.orientation, fields);
  fields.set("BONDED", protocol.bonded);
  fields.set("RATE", protocol.rate_deg_s);
  fields.set("BEGIN", begin);
  fields.set("HEIGHT", pose.height_m);
  fields.set("MOST", dem::most_slip_m(facts.grain()));
  fields.set("ROOM", 10 * body.reach_m());
  fields.set("SETTLE_STEPS", steps(.05, timestep));
  fields.set("EVERY", steps(.002, timestep));
  return {.name = "tilt.lig", .text = filled("liggghts/tilt.lig", fields)};
}

ExportedFile roll_file(const ExportFacts& facts) {
  const dem::RollProtocol& protocol = facts.study().protocol<dem::RollProtocol>();
  const std::vector<dem::Grain> starts = facts.roll_starts();
  const double reach = facts.grain().reach_m();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::RollProtocol>());
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::RollProtocol>());
  set_body(facts.grain(), facts.study().model.grain_material.density_kg_m3, fields);
  fields.set("RELEASE_MM", 1e3 * protocol.release_m);
  fields.set("INCLINE", protocol.incline_deg);
  fields.set("RELEASES", static_cast<int>(starts.size()));
  int number = 0;
  for (const dem::Grain& start : starts) {
    DeckFields& own = fields.add_section("POSE");
    own.set("NUMBER", ++number);
    own.set("X", start.position.x());
    own.set("Z", start.position.z());
    set_pose(start.orientation, own);
  }
  fields.set("BEHIND", 5 * (protocol.release_m + 10 * reach));
  fields.set("FLAT", facts.roll_flat_m());
  fields.set("END", facts.roll_flat_m() - 2 * reach);  // there it would be lost
  fields.set("ROOM", 10 * (protocol.release_m + 10 * reach));
  fields.set("TOP", 5 * (protocol.release_m + 10 * reach));
  fields.set("EVERY", steps(.1, timestep));
  fields.set("STEPS", steps(60, timestep));
  fields.set("REST", 1e-3 * reach);
  return {.name = "roll.lig", .text = filled("liggghts/roll.lig", fields)};
}

double largest_radius_m(const dem::ClumpShape& grain) {
  double largest = 0;
  for (const dem::ClumpSphere& sphere : grain.spheres) largest = std::max(largest, sphere.radius);
  return largest;
}

ExportedFile heap_file(const ExportFacts& facts) {
  constexpr double kLook_s = .02;
  constexpr double kInsert_s = .02;
  constexpr int kAttempts = 100;  // meanwhile all fall, leaving the column's top empty
  const dem::HeapProtocol& protocol = facts.study().protocol<dem::HeapProtocol>();
  const double reach = facts.grain().reach_m();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::HeapProtocol>());
  const double tube_m3 = std::numbers::pi / 4 * protocol.tube_diameter_m *
                         protocol.tube_diameter_m * protocol.tube_height_m;
  const int grains = grains_in_heap(facts);
  constexpr double kLoose = .12;  // of a column, which random insertion fills easily
  const double column =
      grains * facts.grain().volume_m3 / (kLoose * tube_m3) * protocol.tube_height_m;
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::HeapProtocol>());
  mark_shape(facts.is_sphere(), fields);
  fields.set("GRAINS", grains);
  fields.set("SPHERES", static_cast<int>(facts.grain().spheres.size()));
  fields.set("LIFT", protocol.lift_speed_m_s);
  fields.set("LIFT_MM_S", 1e3 * protocol.lift_speed_m_s);
  fields.set("TUBE_RADIUS", .5 * protocol.tube_diameter_m);
  fields.set("COLUMN", column);
  fields.set("INSERT_STEPS", steps(kInsert_s, timestep));
  fields.set("ATTEMPTS", kAttempts);
  // Away from the edge, where grains may fall off.
  fields.set("UNDER", std::max(.5 * protocol.tube_diameter_m, .5 * protocol.plate_m - 2 * reach));
  fields.set("THICKNESS", protocol.plate_thickness_m);
  fields.set("ROOM", .5 * protocol.plate_m + 4 * reach);
  fields.set("BELOW", protocol.plate_thickness_m + 5 * reach);
  fields.set("TOP", column + 2 * protocol.tube_height_m);
  fields.set("FILL_STEPS", steps(1 + std::sqrt(2 * column / kStandardGravity_m_s2), timestep));
  fields.set("RADIUS", largest_radius_m(facts.grain()));
  fields.set("LOOK_STEPS", steps(kLook_s, timestep));
  // As in dem/experiment/rest_test.h.
  fields.set("WINDOW_STEPS", steps(2 * std::sqrt(2 * reach / kStandardGravity_m_s2), timestep));
  fields.set("REST", 1e-3 * reach);
  fields.set("LONGEST_S", kHeapRest_s);
  fields.set("REST_STEPS", steps(kHeapRest_s, timestep));
  return {.name = "heap.lig", .text = filled("liggghts/heap.lig", fields)};
}

std::vector<ExportedFile> liggghts_files(const ExportFacts& facts, const Conversions& conversions) {
  std::vector<ExportedFile> files = {material_file(facts, conversions),
                                     grain_file(facts),
                                     place_file(facts, "place.lig", facts.is_sphere()),
                                     {.name = "clump.txt", .text = spheres_text(facts.grain())}};
  if (facts.has(dem::experiment_of<dem::DropProtocol>())) files.push_back(drop_on_wall_file(facts));
  if (facts.has(dem::experiment_of<dem::TiltProtocol>())) {
    const bool is_sphere =
        facts.is_sphere() && facts.study().protocol<dem::TiltProtocol>().bonded == 1;
    files.push_back(tilt_file(facts));
    files.push_back(place_file(facts, "place_body.lig", is_sphere));
    files.push_back({.name = "body.txt", .text = spheres_text(facts.tilt_body())});
  }
  if (facts.has(dem::experiment_of<dem::RollProtocol>())) {
    files.push_back(roll_file(facts));
    files.push_back({.name = "incline.stl",
                     .text = incline_stl(facts.study().protocol<dem::RollProtocol>(),
                                         facts.grain().reach_m())});
  }
  if (facts.has(dem::experiment_of<dem::HeapProtocol>())) {
    files.push_back(heap_file(facts));
    files.push_back({.name = "tube.stl",
                     .text = tube_stl(facts.study().protocol<dem::HeapProtocol>(), kTubeSides)});
    files.push_back(
        {.name = "plate.stl", .text = plate_stl(facts.study().protocol<dem::HeapProtocol>())});
  }
  for (const auto& more : {liggghts_files_of_pairs(facts), liggghts_files_of_poured_grains(facts),
                           liggghts_files_on_grains(facts)}) {
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

std::string liggghts_program(dem::RollingModel /*model*/) { return "LIGGGHTS-PUBLIC 3.8"; }

RestitutionCounterpart liggghts_restitution(double ours) {
  constexpr double kLeast = .0501;  // it accepts only values above .05
  RestitutionCounterpart theirs{
      .name = "coefficientRestitution",
      .value = std::max(ours, kLeast),
      .fidelity = Fidelity::exact,
      .law = "speed after per speed before a central impact",
      .limits =
          "The damper may pull and has the textbook factor, which then gives the same rebound of a "
          "sphere. Spheres of a clump that land at once lose a different fraction of the speed "
          "from "
          "ours."};
  if (theirs.value > ours) {
    theirs.fidelity = Fidelity::approximate;
    theirs.limits = "LIGGGHTS accepts only values above .05.";
  }
  return theirs;
}

std::string liggghts_rolling_law(dem::RollingModel model) {
  if (model == dem::RollingModel::none) return "no rolling model";
  return model == dem::RollingModel::elastic_plastic
             ? "epsd: rolling spring, up to mu_r F R*, against the relative rotation"
             : "cdt: mu_r F R* against the relative spin, F without the damper's part";
}

RollingConversion liggghts_rolling(dem::RollingModel model, Partner partner,
                                   const dem::ClumpShape& grain) {
  RollingConversion converted = to_relative_spin(model, partner, grain, 1);
  if (model == dem::RollingModel::relative_constant_torque) {
    converted.limits +=
        "Theirs trembles about rest, and lets what it should hold creep, the slower the shorter "
        "the time step; ours holds it. ";
  } else if (model == dem::RollingModel::constant_torque) {
    converted.limits +=
        "Theirs leaves out spin about the contact's normal, and trembles about rest where ours "
        "stops dead. ";
  }
  return converted;
}

bool liggghts_has_deck(const dem::Protocol& protocol) {
  if (is_one_of<dem::FillProtocol>(protocol)) {
    const auto& fill = protocol.as<dem::FillProtocol>();
    return !fill.taps && !fill.pour_kg_s;
  }
  return is_one_of<dem::DropProtocol, dem::TiltProtocol, dem::RollProtocol, dem::HeapProtocol,
                   dem::GrainDropProtocol, dem::GrainTiltProtocol, dem::GrainRollProtocol,
                   dem::PendulumProtocol, dem::DrawDownProtocol>(protocol);
}

}  // namespace

ExportTarget liggghts_target() {
  static constexpr TargetEntry kTarget{
      .name = "liggghts",
      .summary = "decks for all experiments but fills that are tapped",
      .has_tables = false,
      .takes_incline_material = true,
      .program = liggghts_program,
      .restitution = liggghts_restitution,
      .heap_file = "heap.dump",
      .heap_unit = "m",
      .sliding_name = "coefficientFriction",
      .sliding_limits =
          "Their spring keeps its force when the contact unloads, ours shrinks with the contact: "
          "oblique impacts cause slightly more spin.",
      .rolling_name = "coefficientRollingFriction",
      .rolling_law = liggghts_rolling_law,
      .rolling = liggghts_rolling,
      .has_deck = liggghts_has_deck,
      .files = liggghts_files};
  return &kTarget;
}

}  // namespace repose::calibrate
