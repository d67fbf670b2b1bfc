#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_roll(Protocol& protocol) {
  constexpr Range kSlope{.from = 0, .to = 90, .excludes_from = true, .excludes_to = true};
  auto& roll = std::get<RollProtocol>(protocol);
  return {number_key("incline_deg", "20", kSlope, roll.incline_deg),
          length_key("release_mm", "150", roll.release_m),
          number_key("release_turn_deg", "10", {.from = 0, .to = 90}, roll.release_turn_deg)};
}

/// Nothing limits how far it may roll but the fit, see kMaxReading.
Range possible_roll(const Model& /*model*/, const Protocol& /*protocol*/) { return {.from = 0}; }

double cost_of_roll_s(const Model& model, const Protocol& /*protocol*/) {
  constexpr double kSpeed_m_s = 1, kRun_s = 2;
  return step_on_wall_s(model, 1) * kRun_s / bulk_timestep_s(model, kSpeed_m_s);
}

}  // namespace

ExperimentEntry roll_entry() {
  return {
      .experiment = Experiment::roll,
      .name = "roll",
      .unit = "mm",
      .value_name = "rolling distance",
      .description =
          "A grain is laid across an incline, let go, and rolls on along the flat plate. One that "
          "stays on the incline is let go again, up to ten times, and then counts as 0. The "
          "distance is from the foot of the incline.",
      .readings = {{"lateral_mm", "mm"},
                   {"stopped_on_incline", ""},
                   {"releases", ""},
                   {"hop_mm", "mm"},
                   {"time_s", "s"}},
      .coefficients = {kWallRestitution, kWallSliding, kWallRolling},
      .parts = {WallPart::incline},
      .tells = kWallRolling,
      .sheet = {.test = "rolling",
                .value = "stopped_mm",
                .protocol = {{"incline_deg", "incline_deg"}, {"released_mm", "release_mm"}}},
      .is_filmed = true,
      .usual_scatter = .35,
      .usual_model_error = .02,
      .usual = RollProtocol{},
      .keys = keys_of_roll,
      .run =
          [](const Model& model, const Protocol& protocol, std::uint64_t seed,
             const ProgressReport& report, const RunRecord& record) {
            return run_roll(model, std::get<RollProtocol>(protocol), seed, report, record);
          },
      .possible = possible_roll,
      .cost_s = cost_of_roll_s};
}

}  // namespace repose::dem
