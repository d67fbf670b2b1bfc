#include "dem/experiment/glued_bed.h"
#include "dem/experiment/model_setup.h"
#include "dem/study/entries.h"

/// Plates that are covered with glued grains: nothing but grains touch.
namespace repose::dem {
namespace {

ProtocolKey coverage_key(double& coverage) {
  return number_key("coverage", "0.75", from_to(kMinCoverage, kMaxCoverage), coverage);
}

std::vector<ProtocolKey> drop_keys(Protocol& protocol) {
  auto& drop = std::get<GrainDropProtocol>(protocol);
  return {length_key("height_mm", "200", drop.height_m),
          count_key("grains", "20", kMaxGrains, drop.grains), coverage_key(drop.coverage)};
}

std::vector<ProtocolKey> tilt_keys(Protocol& protocol) {
  constexpr int kMaxBonded = 10;
  auto& tilt = std::get<GrainTiltProtocol>(protocol);
  return {count_key("bonded", "3", kMaxBonded, tilt.bonded),
          number_key("rate_deg_s", "5", above(0, 10), tilt.rate_deg_s),
          count_key("places", "10", kMaxGrains, tilt.places), coverage_key(tilt.coverage)};
}

std::vector<ProtocolKey> roll_keys(Protocol& protocol) {
  auto& roll = std::get<GrainRollProtocol>(protocol);
  return {number_key("rate_deg_s", "5", above(0, 10), roll.rate_deg_s),
          count_key("places", "10", kMaxGrains, roll.places), coverage_key(roll.coverage)};
}

/// From a hollow between glued grains to standing above them, beside the height of the fall.
Range possible_rise(const Model& model, const Protocol& protocol) {
  const double height_m = std::get<GrainDropProtocol>(protocol).height_m;
  return from_to(0, 1e3 * (height_m + 4 * model.grain.reach_m()));
}

Range possible_angle(const Model& /*model*/, const Protocol& /*protocol*/) {
  return from_to(0, 90);
}

/// A grain touches several others, again and again, before it is thrown up.
double drop_cost_s(const Model& model, const Protocol& protocol) {
  constexpr double kSteps = 1e4;
  const int grains = std::get<GrainDropProtocol>(protocol).grains;
  return grains * (kImpact_s + kSteps * step_on_grains_s(model, 1));
}

/// Of bodies that lie still until the plate is at some 45 degrees.
double tilt_cost_s(const Model& model, double rate_deg_s, int bonded, int places) {
  constexpr double kSpeed_m_s = .3, kSettling_s = 1, kLeaves_deg = 45;
  return step_on_grains_s(model, bonded) * places * (kSettling_s + kLeaves_deg / rate_deg_s) /
         rolling_timestep_s(model, kSpeed_m_s);
}

}  // namespace

/// Of 6 mm glass beads and of hazelnuts alike, restitution from .2 to .8 moved the rise twentyfold,
/// rolling friction from .02 to .2 by a third of it, sliding friction by less than it scatters.
ExperimentEntry drop_on_grains_entry() {
  return {.experiment = Experiment::drop_on_grains,
          .name = "drop_on_grains",
          .unit = "mm",
          .value_name = "rebound height from grains",
          .description = "A grain falls on a plate that is covered with glued grains of its kind.",
          .readings = {{"lowest_point_rise_mm", "mm"},
                       {"above_first_touch_mm", "mm"},
                       {"sd_mm", "mm"},
                       {"never_rose", ""}},
          .coefficients = {kGrainRestitution, kGrainSliding, kGrainRolling},
          .tells = kGrainRestitution,
          .sheet = {.test = "drop_on_grains",
                    .value = "rebound_mm",
                    .protocol = {{"drop_mm", "height_mm"}}},
          .is_default = false,
          .is_in_air = true,
          .readings_per_run =
              [](const Protocol& protocol) { return std::get<GrainDropProtocol>(protocol).grains; },
          .softening_effect = "rebounds less than one with the real stiffness",
          .usual_scatter = .45,
          .usual_model_error = .03,
          .usual = GrainDropProtocol{},
          .keys = drop_keys,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_drop_on_grains(model, std::get<GrainDropProtocol>(protocol), seed,
                                          report, record);
              },
          .possible = possible_rise,
          .cost_s = drop_cost_s};
}

/// Sliding friction from .2 to .6 moved the angle by some 18 degrees, rolling friction from .02 to
/// .2 by 0 to 3, restitution by less than it scatters.
ExperimentEntry tilt_on_grains_entry() {
  return {.experiment = Experiment::tilt_on_grains,
          .name = "tilt_on_grains",
          .unit = "deg",
          .value_name = "angle of sliding on grains",
          .description =
              "Three or more grains, glued side by side so that none can roll, lie on a plate that "
              "is covered with glued grains of their kind, while it is tilted slowly, until they "
              "slide by a grain's diameter.",
          .readings = {{"first_shift_deg", "deg"}, {"sd_deg", "deg"}},
          .coefficients = {kGrainSliding, kGrainRolling},
          .tells = kGrainSliding,
          .sheet = {.test = "tilt_on_grains", .value = "angle_deg"},
          .is_default = false,
          .readings_per_run =
              [](const Protocol& protocol) { return std::get<GrainTiltProtocol>(protocol).places; },
          .usual_scatter = .2,
          .usual_model_error = .03,
          .usual = GrainTiltProtocol{},
          .keys = tilt_keys,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_tilt_on_grains(model, std::get<GrainTiltProtocol>(protocol), seed,
                                          report, record);
              },
          .possible = possible_angle,
          .cost_s =
              [](const Model& model, const Protocol& protocol) {
                const auto& tilt = std::get<GrainTiltProtocol>(protocol);
                return tilt_cost_s(model, tilt.rate_deg_s, tilt.bonded, tilt.places);
              }};
}

/// Rolling friction from .02 to .2 moved the angle by some 12 degrees, sliding friction and
/// restitution by less than it scatters.
ExperimentEntry roll_on_grains_entry() {
  return {.experiment = Experiment::roll_on_grains,
          .name = "roll_on_grains",
          .unit = "deg",
          .value_name = "angle of rolling on grains",
          .description =
              "A single grain lies on a plate that is covered with glued grains of its kind, while "
              "it is tilted slowly, until the grain rolls by its diameter.",
          .readings = {{"first_shift_deg", "deg"}, {"sd_deg", "deg"}},
          .coefficients = {kGrainSliding, kGrainRolling},
          .tells = kGrainRolling,
          .sheet = {.test = "roll_on_grains", .value = "angle_deg"},
          .is_default = false,
          .readings_per_run =
              [](const Protocol& protocol) { return std::get<GrainRollProtocol>(protocol).places; },
          .usual_scatter = .25,
          .usual_model_error = .03,
          .usual = GrainRollProtocol{},
          .keys = roll_keys,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_roll_on_grains(model, std::get<GrainRollProtocol>(protocol), seed,
                                          report, record);
              },
          .possible = possible_angle,
          .cost_s =
              [](const Model& model, const Protocol& protocol) {
                const auto& roll = std::get<GrainRollProtocol>(protocol);
                return tilt_cost_s(model, roll.rate_deg_s, 1, roll.places);
              }};
}

}  // namespace repose::dem
