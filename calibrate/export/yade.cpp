#include <cmath>
#include <numbers>

#include "base/units.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/rolling.h"
#include "calibrate/export/target_entry.h"
#include "dem/contact/restitution.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"

namespace repose::calibrate {
namespace {

/// Contacts with the real stiffness, from an experiment that the study has, so that no
/// particle–particle value is needed without a heap.
dem::ContactTable real_contacts(const ExportFacts& facts) {
  const dem::Experiment any = facts.experiments().front();
  dem::Model model = dem::model_for(facts.study(), any);
  model.stiffness_factor = 1;
  const dem::Wall wall = dem::study_wall(dem::Plane{});
  return dem::model_setup(model, facts.grain(), {wall}, 1).contacts;
}

void set_pair(const std::string& prefix, const std::string& pair, double restitution,
              const ExportFacts& facts, const Conversions& conversions, const dem::ContactLaw& law,
              DeckFields& fields) {
  const double radius = facts.grain().spheres.front().radius;
  fields.set(prefix + "_BETAN", exported(conversions, pair + "restitution"));
  fields.set(prefix + "_BETAS", dem::textbook_damping_factor(restitution) / 2);
  fields.set(prefix + "_SLIDING", exported(conversions, pair + "sliding_friction"));
  fields.set(prefix + "_ETA", exported(conversions, pair + "rolling_friction"));
  fields.set(prefix + "_KROT", rolling_stiffness(law, facts.mass_kg(), radius));
}

/// For heaps: no other YADE experiment has a part of another material.
bool has_own_tube(const ExportFacts& facts) {
  return facts.has(dem::experiment_of<dem::HeapProtocol>()) &&
         facts.study().model.parts.contains(dem::WallPart::tube);
}

ExportedFile yade_grain_file(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Study& study = facts.study();
  const dem::ContactTable contacts = real_contacts(facts);
  const dem::ContactLaw& wall = contacts.law(dem::kGrainMaterial, dem::kWallMaterial);
  const dem::ContactLaw& grain = contacts.law(dem::kGrainMaterial, dem::kGrainMaterial);
  const LikeMaterial pair = like_material(wall);
  DeckFields fields = common_fields(facts);
  add_balls(facts.grain(), fields);
  set_body(facts.grain(), study.model.grain_material.density_kg_m3, fields);
  fields.set("REACH", facts.grain().reach_m());
  fields.set("DENSITY", study.model.grain_material.density_kg_m3);
  // YADE's reduced radius on a wall is half the sphere's, and stiffness scales with its square
  // root.
  fields.set("PAIR_YOUNG", std::numbers::sqrt2 * pair.young_modulus_pa);
  fields.set("PAIR_POISSON", pair.poisson_ratio);
  fields.set("GRAIN_YOUNG", study.model.grain_material.young_modulus_pa);
  fields.set("GRAIN_POISSON", study.model.grain_material.poisson_ratio);
  const std::string walls = "contact.particle_wall.";
  // Without a heap grains never touch each other.
  const bool has_heap = facts.has(dem::experiment_of<dem::HeapProtocol>());
  const std::string grains = has_heap ? "contact.particle_particle." : walls;
  const dem::PairCoefficients& with_wall = study.model.grain_wall;
  set_pair("WALL", walls, with_wall.restitution, facts, conversions, wall, fields);
  set_pair("GRAIN", grains, (has_heap ? study.model.grain_grain : with_wall).restitution, facts,
           conversions, grain, fields);
  if (has_own_tube(facts)) {
    const dem::WallSurface& surface = facts.surface(dem::WallPart::tube);
    DeckFields& tube = fields.add_section("TUBE");
    tube.set("TUBE_NAME", sanitized(surface.material.name));
    set_pair("TUBE", "contact.particle_tube.", surface.with_grain.restitution, facts, conversions,
             facts.law(dem::experiment_of<dem::HeapProtocol>(), dem::WallPart::tube), tube);
  }
  return {.name = "grain.py", .text = filled("yade/grain.py", fields)};
}

DeckFields yade_fields(const ExportFacts& facts, dem::Experiment experiment) {
  DeckFields fields = common_fields(facts);
  fields.set("STIFFNESS", facts.stiffness(experiment));
  fields.set("TIMESTEP", facts.timestep_s(experiment));
  return fields;
}

ExportedFile yade_drop_file(const ExportFacts& facts) {
  const dem::DropProtocol& protocol = facts.study().protocol<dem::DropProtocol>();
  const double speed = facts.speed_m_s(dem::experiment_of<dem::DropProtocol>());
  const double reach = facts.grain().reach_m();
  DeckFields fields = yade_fields(facts, dem::experiment_of<dem::DropProtocol>());
  fields.set("HEIGHT_MM", 1e3 * protocol.height_m);
  fields.set("GRAINS", protocol.grains);
  fields.set("SPEED", speed);
  fields.set("SPACING", 8 * (protocol.height_m + reach));
  fields.set("EVERY", 5);
  fields.set("STEPS", steps(facts.longest_drop_s(dem::experiment_of<dem::DropProtocol>()),
                            facts.timestep_s(dem::experiment_of<dem::DropProtocol>())));
  for (const TouchingPose& pose : facts.drop_poses()) {
    DeckFields& own = fields.add_section("POSE");
    own.set("HEIGHT", pose.height_m);
    set_pose(pose.orientation, own);
  }
  return {.name = "drop.py", .text = filled("yade/drop.py", fields)};
}

ExportedFile yade_tilt_file(const ExportFacts& facts) {
  const dem::TiltProtocol& protocol = facts.study().protocol<dem::TiltProtocol>();
  const TouchingPose pose = facts.tilt_pose();
  const double begin = facts.tilt_begin_deg();
  DeckFields fields = yade_fields(facts, dem::experiment_of<dem::TiltProtocol>());
  add_balls(facts.tilt_body(), fields);
  set_body(facts.tilt_body(), facts.study().model.grain_material.density_kg_m3, fields);
  set_pose(pose.orientation, fields);
  fields.set("BONDED", protocol.bonded);
  fields.set("RATE", protocol.rate_deg_s);
  fields.set("BEGIN", begin);
  fields.set("HEIGHT", pose.height_m);
  fields.set("STEPS", steps(.1 + (90 - begin) / protocol.rate_deg_s,
                            facts.timestep_s(dem::experiment_of<dem::TiltProtocol>())));
  return {.name = "tilt.py", .text = filled("yade/tilt.py", fields)};
}

ExportedFile yade_roll_file(const ExportFacts& facts) {
  const dem::RollProtocol& protocol = facts.study().protocol<dem::RollProtocol>();
  const dem::Grain start = facts.roll_start();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::RollProtocol>());
  const double length = 4 * (protocol.release_m + 10 * facts.grain().reach_m());
  DeckFields fields = yade_fields(facts, dem::experiment_of<dem::RollProtocol>());
  set_pose(start.orientation, fields);
  fields.set("RELEASE_MM", 1e3 * protocol.release_m);
  fields.set("INCLINE", protocol.incline_deg);
  fields.set("HALF_FOOT", 2 * length);
  fields.set("APEX_X", -length * std::cos(protocol.incline_deg * kDegree));
  fields.set("APEX_Z", length * std::sin(protocol.incline_deg * kDegree));
  fields.set("X", start.position.x());
  fields.set("Y", start.position.y());
  fields.set("Z", start.position.z());
  fields.set("EVERY", steps(.1, timestep));
  fields.set("STEPS", steps(60, timestep));
  return {.name = "roll.py", .text = filled("yade/roll.py", fields)};
}

ExportedFile yade_heap_file(const ExportFacts& facts) {
  const dem::HeapProtocol& protocol = facts.study().protocol<dem::HeapProtocol>();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::HeapProtocol>());
  const double reach = facts.grain().reach_m();
  const int grains = grains_in_heap(facts);
  DeckFields fields = yade_fields(facts, dem::experiment_of<dem::HeapProtocol>());
  fields.set("GRAINS", grains);
  fields.set("LIFT", protocol.lift_speed_m_s);
  fields.set("LIFT_MM_S", 1e3 * protocol.lift_speed_m_s);
  fields.set("PLATE", protocol.plate_m);
  fields.set("TUBE_MATERIAL", std::string(has_own_tube(facts) ? "tube" : "wall"));
  fields.set("TUBE_RADIUS", .5 * protocol.tube_diameter_m);
  fields.set("TUBE_HEIGHT", protocol.tube_height_m);
  // A layer holds at least one grain.
  const double column = 2.02 * reach * grains;
  fields.set("COLUMN", column);
  fields.set("FILL_STEPS", steps(1 + std::sqrt(2 * column / kStandardGravity_m_s2), timestep));
  fields.set("LIFT_STEPS", steps(lift_s(protocol), timestep));
  fields.set("REST_STEPS", steps(kHeapRest_s, timestep));
  return {.name = "heap.py", .text = filled("yade/heap.py", fields)};
}

std::vector<ExportedFile> yade_files(const ExportFacts& facts, const Conversions& conversions) {
  std::vector<ExportedFile> files = {yade_grain_file(facts, conversions)};
  if (facts.has(dem::experiment_of<dem::DropProtocol>())) files.push_back(yade_drop_file(facts));
  if (facts.has(dem::experiment_of<dem::TiltProtocol>())) files.push_back(yade_tilt_file(facts));
  if (facts.has_deck(dem::experiment_of<dem::RollProtocol>()))
    files.push_back(yade_roll_file(facts));
  if (facts.has(dem::experiment_of<dem::HeapProtocol>())) files.push_back(yade_heap_file(facts));
  return files;
}

std::string yade_program(dem::RollingModel /*model*/) { return "YADE 2023.02"; }

RestitutionCounterpart yade_restitution(double ours) {
  return {.name = "betan",
          .value = dem::damping_factor(ours) / 2,
          .fidelity = Fidelity::exact,
          .law = "damper 2 betan sqrt(S_n m*), which never pulls: betan is half of our factor c(e)",
          .limits = "A clump's spheres are given the clump's mass, which YADE uses for damping."};
}

std::string yade_rolling_law(dem::RollingModel /*model*/) {
  return "includeMoment: bending spring krot, up to eta F (R1 + R2) / 2, against the relative "
         "rotation; a wall counts with the sphere's radius";
}

RollingConversion yade_rolling(dem::RollingModel model, Partner partner,
                               const dem::ClumpShape& grain) {
  constexpr double kMeanOfRadii = 2;  // R, of two equal spheres, in R*
  RollingConversion converted = to_relative_spin(model, partner, grain, kMeanOfRadii);
  const bool is_own_spin = model == dem::RollingModel::constant_torque;
  if (!is_own_spin && partner == Partner::grain && !has_equal_radii(grain)) {
    converted.fidelity = Fidelity::approximate;
    converted.limits =
        "Their lever is the mean of both radii, ours R*: the factor is that of equal radii, and "
        "the grain's spheres differ. ";
  }
  limit_to_fixed_spring(converted);
  return converted;
}

bool yade_has_deck(const dem::Protocol& protocol) {
  return is_one_of<dem::DropProtocol, dem::TiltProtocol, dem::RollProtocol, dem::HeapProtocol>(
      protocol);
}

}  // namespace

ExportTarget yade_target() {
  static constexpr TargetEntry kTarget{
      .name = "yade",
      .summary = "scripts for drop, tilt, roll and heap",
      .has_tables = false,
      .takes_incline_material = false,  // all its contacts have the same rolling friction
      .program = yade_program,
      .restitution = yade_restitution,
      .heap_file = "heap.txt",
      .heap_unit = "",
      .sliding_name = "tangent of frictAngle",
      .sliding_limits =
          "Their spring keeps its force when the contact unloads, ours shrinks with the contact: "
          "oblique impacts cause slightly more spin.",
      .rolling_name = "eta",
      .rolling_law = yade_rolling_law,
      .rolling = yade_rolling,
      .has_deck = yade_has_deck,
      .files = yade_files};
  return &kTarget;
}

}  // namespace repose::calibrate
