#include "calibrate/export/facts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "base/version.h"
#include "calibrate/export/deck_template.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"

namespace repose::calibrate {

namespace {

/// The plate begins to turn this far below the sliding angle, degrees.
constexpr double kTiltLead_deg = 3;
/// For a grain without rolling friction, brought to rest only by its shape.
constexpr double kLongestFlat_m = 20;

TouchingPose touching(const dem::ClumpShape& shape, const dem::Quaternion& orientation) {
  return {.orientation = orientation,
          .height_m = dem::reach_towards(shape, orientation, -dem::Vector::UnitZ())};
}

/// Names of all experiments with a deck: "drop, tilt".
std::string names_with_decks(ExportTarget target) {
  std::string names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    if (!target->has_deck(entry.usual)) continue;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return names;
}

}  // namespace

ExportFacts::ExportFacts(dem::Study study, dem::ClumpShape grain, std::vector<FittedValue> fitted,
                         ExportTarget target)
    : study_(std::move(study)), fitted_(std::move(fitted)), target_(target) {
  study_.model.grain = std::move(grain);
  for (const NamedCoefficient& named : coefficients_of(study_)) {
    if (named.coefficient.is_free()) {
      coefficient_named(named.name, study_.model) = std::nan("");
    }
  }
  for (const FittedValue& value : fitted_) {
    coefficient_named(value.name, study_.model) = value.value;
  }
  base::Faults errors;
  const auto is_needed_in = [this](const std::string& name) {
    if (name.starts_with("contact.particle_wall.")) return true;
    if (name.starts_with("contact.particle_particle.")) return has_grain_contacts();
    return std::ranges::any_of(parts(), [&](dem::WallPart part) {
      return name.starts_with("contact.particle_" + name_of(part) + '.');
    });
  };
  for (const NamedCoefficient& named : coefficients_of(study_)) {
    const bool is_needed = is_needed_in(named.name);
    errors.require(
        !is_needed || std::isfinite(coefficient_named(named.name, study_.model)),
        {.where = named.name,
         .value = "has no value in the result",
         .fix = "give the study a value for it, or bounds and a measurement that determines it."});
  }
  errors.require(
      !experiments().empty(),
      {.value = fmt::format("the study has no experiment that {} has a deck for", name_of(target)),
       .rule = fmt::format("one of {} at least", names_with_decks(target)),
       .fix = "add a section for one, such as [experiment.drop]."});
  errors.throw_if_any();
}

double ExportFacts::mass_kg() const {
  return study_.model.grain_material.density_kg_m3 * grain().volume_m3;
}

double ExportFacts::ball_density_kg_m3() const {
  return mass_kg() / dem::sphere_shape(grain().spheres.front().radius).volume_m3;
}

std::vector<dem::Experiment> ExportFacts::experiments() const {
  std::vector<dem::Experiment> there;
  for (const auto& [experiment, described] : study_.experiments) {
    if (has_deck(experiment)) there.push_back(experiment);
  }
  return there;
}

std::vector<dem::Experiment> ExportFacts::left_out() const {
  std::vector<dem::Experiment> others;
  for (const auto& [experiment, described] : study_.experiments) {
    if (!has_deck(experiment)) others.push_back(experiment);
  }
  return others;
}

bool ExportFacts::has_deck(dem::Experiment experiment) const {
  const auto found = study_.experiments.find(experiment);
  if (found == study_.experiments.end()) return false;
  const bool has_own_incline =
      dem::model_for(study_, experiment).parts.contains(dem::WallPart::incline);
  if (has_own_incline && !target_->takes_incline_material) return false;
  return target_->has_deck(found->second.protocol);
}

std::vector<dem::WallPart> ExportFacts::parts() const {
  std::vector<dem::WallPart> there;
  for (const auto& [part, surface] : study_.model.parts) {
    const bool is_used = std::ranges::any_of(experiments(), [part](dem::Experiment experiment) {
      const auto& own = experiment->parts;
      return std::ranges::find(own, part) != own.end();
    });
    if (is_used) there.push_back(part);
  }
  return there;
}

dem::ContactLaw ExportFacts::law(dem::Experiment experiment, dem::WallPart part) const {
  const int material = dem::material_of(dem::model_for(study_, experiment), part);
  return contacts(experiment).law(dem::kGrainMaterial, material);
}

bool ExportFacts::has_grain_contacts() const {
  return std::any_of(study_.experiments.begin(), study_.experiments.end(),
                     [](const auto& one) { return dem::has_grain_contacts(one.first); });
}

double ExportFacts::stiffness(dem::Experiment experiment) const {
  return dem::model_for(study_, experiment).stiffness_factor;
}

dem::ContactTable ExportFacts::contacts(dem::Experiment experiment) const {
  const dem::Model model = dem::model_for(study_, experiment);
  return dem::model_setup(model, grain(), {dem::study_wall(dem::Plane{})}, 1).contacts;
}

std::vector<TouchingPose> ExportFacts::drop_poses() const {
  dem::Random random(study_.seed);
  std::vector<TouchingPose> poses;
  for (int k = 0; k < study_.protocol<dem::DropProtocol>().grains; ++k) {
    poses.push_back(touching(grain(), random.orientation()));
  }
  return poses;
}

double ExportFacts::longest_drop_s(dem::Experiment drop) const {
  return 2 * speed_m_s(drop) / kStandardGravity_m_s2 +
         4 * std::sqrt(2 * grain().reach_m() / kStandardGravity_m_s2);
}

dem::ClumpShape ExportFacts::tilt_body() const {
  return dem::bonded_shape(grain(), study_.protocol<dem::TiltProtocol>().bonded);
}

TouchingPose ExportFacts::tilt_pose() const {
  return touching(tilt_body(), dem::lying_pose(grain()));
}

double ExportFacts::tilt_begin_deg() const {
  const double slides_deg = std::atan(study_.model.grain_wall.sliding_friction) / kDegree;
  return std::max(
      {0.0, study_.protocol<dem::TiltProtocol>().start_deg, slides_deg - kTiltLead_deg});
}

dem::Grain ExportFacts::roll_start() const { return roll_starts().front(); }

std::vector<dem::Grain> ExportFacts::roll_starts() const {
  dem::Random random(study_.seed);
  std::vector<dem::Grain> starts;
  for (int k = 0; k < dem::most_releases(grain()); ++k) {
    starts.push_back(dem::released(grain(), study_.protocol<dem::RollProtocol>(), random));
  }
  return starts;
}

double ExportFacts::roll_flat_m() const {
  const double friction = study_.model.grain_wall.rolling_friction;
  const double slope = study_.protocol<dem::RollProtocol>().incline_deg * kDegree;
  const auto incline = study_.model.parts.find(dem::WallPart::incline);
  const double on_incline =
      incline == study_.model.parts.end() ? friction : incline->second.with_grain.rolling_friction;
  // Without loss at the foot: L = S (sin - mu_r cos) / mu_r, see dem/THEORY.md; the work done up
  // the incline is that of its own mu_r.
  const double longest =
      study_.protocol<dem::RollProtocol>().release_m *
      std::max(0.0, std::sin(slope) / friction - on_incline / friction * std::cos(slope));
  const double room = .5 + 20 * grain().reach_m();
  return std::isfinite(longest) ? std::min(longest + room, kLongestFlat_m) : kLongestFlat_m;
}

LikeMaterial like_material(const dem::ContactLaw& pair) {
  const double fraction = pair.reduced_shear_pa / pair.reduced_young_pa;
  const double poisson = (1 - 4 * fraction) / (1 - 2 * fraction);
  return {.young_modulus_pa = 2 * pair.reduced_young_pa * (1 - poisson * poisson),
          .poisson_ratio = poisson};
}

double rolling_stiffness(const dem::ContactLaw& pair, double mass_kg, double radius_m) {
  const double weight = mass_kg * kStandardGravity_m_s2;
  const double spring = 4.0 / 3 * pair.reduced_young_pa * std::sqrt(radius_m);
  const double overlap = std::pow(weight / spring, 2.0 / 3);
  const double arm = pair.rolling_friction * radius_m;
  return 2.25 * spring * std::sqrt(overlap) * arm * arm;
}

DeckFields common_fields(const ExportFacts& facts) {
  const dem::Study& study = facts.study();
  DeckFields fields;
  fields.set("PROGRAM", base::kProgram);
  fields.set("STUDY", sanitized(study.file.filename().string()));
  fields.set("HASH", sanitized(study.hash));
  fields.set("GRAIN_NAME", sanitized(study.model.grain_material.name));
  fields.set("WALL_NAME", sanitized(study.model.wall_material.name));
  fields.set("GRAVITY", kStandardGravity_m_s2);
  fields.set("MASS", facts.mass_kg());
  for (const FittedValue& value : facts.fitted()) {
    DeckFields& fitted = fields.add_section("FITTED");
    fitted.set("NAME", sanitized(value.name));
    fitted.set("VALUE", fmt::format("{:.4g}", value.value));
    fitted.set("INTERVAL", value.high > value.low ? fmt::format("95 % interval {:.3g} to {:.3g}",
                                                                value.low, value.high)
                                                  : std::string("no interval"));
    fitted.set("VERDICT", value.verdict.empty() ? "not judged" : sanitized(value.verdict));
  }
  return fields;
}

void set_body(const dem::ClumpShape& shape, double density_kg_m3, DeckFields& fields) {
  const double mass = density_kg_m3 * shape.volume_m3;
  fields.set("SPHERES", static_cast<int>(shape.spheres.size()));
  fields.set("BODY_MASS", mass);
  fields.set("IXX", mass * shape.gyration_m2.x());
  fields.set("IYY", mass * shape.gyration_m2.y());
  fields.set("IZZ", mass * shape.gyration_m2.z());
}

void add_balls(const dem::ClumpShape& shape, DeckFields& fields) {
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    DeckFields& ball = fields.add_section("BALL");
    ball.set("X", sphere.centre.x());
    ball.set("Y", sphere.centre.y());
    ball.set("Z", sphere.centre.z());
    ball.set("R", sphere.radius);
  }
}

void set_pose(const dem::Quaternion& orientation, DeckFields& fields) {
  fields.set("QW", orientation.w());
  fields.set("QX", orientation.x());
  fields.set("QY", orientation.y());
  fields.set("QZ", orientation.z());
}

std::string steps(double time_s, double timestep_s) {
  return fmt::format("{:.0f}", std::ceil(time_s / timestep_s));
}

int grains_in_heap(const ExportFacts& facts) {
  const dem::HeapProtocol& protocol = facts.study().protocol<dem::HeapProtocol>();
  constexpr double kPacked = .58;  // fraction filled by poured grains in a tube a few grains across
  const double area = std::numbers::pi / 4 * protocol.tube_diameter_m * protocol.tube_diameter_m;
  const double fitting = kPacked * area * protocol.tube_height_m / facts.grain().volume_m3;
  return protocol.grains.value_or(static_cast<int>(fitting));
}

double lift_s(const dem::HeapProtocol& protocol) {
  constexpr double kLifted = .6;  // of the tube's height; heaps are a third of it
  return kLifted * protocol.tube_height_m / protocol.lift_speed_m_s;
}

namespace {

/// Unlike ours, other programs do not average the first and last step of an impact.
constexpr double kTimestepFraction = .5;

}  // namespace

double ExportFacts::speed_m_s(dem::Experiment experiment) const {
  const dem::Protocol& protocol = study_.experiments.at(experiment).protocol;
  return std::sqrt(2 * kStandardGravity_m_s2 * experiment->fall_m(grain(), protocol));
}

double ExportFacts::timestep_s(dem::Experiment experiment) const {
  dem::Model model = dem::model_for(study_, experiment);
  model.timestep_fraction = kTimestepFraction;
  model.timestep_s = {};
  dem::ClumpShape shape = grain();
  if (experiment->body != nullptr) {
    shape = experiment->body(shape, study_.experiments.at(experiment).protocol);
  }
  std::vector<dem::Wall> walls;
  if (experiment->has_plate) walls.push_back(dem::study_wall(dem::Plane{}));
  const double fraction =
      has_longer_steps_ && experiment->is_bulk ? dem::kBulkFraction : dem::kImpactFraction;
  return dem::model_setup(model, shape, walls, speed_m_s(experiment), fraction).timestep_s;
}

}  // namespace repose::calibrate
