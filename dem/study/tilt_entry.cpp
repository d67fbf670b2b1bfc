#include "dem/experiment/tilt.h"
#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_tilt(Protocol& protocol) {
  constexpr int kMaxBonded = 100;
  auto& tilt = std::get<TiltProtocol>(protocol);
  return {count_key("bonded", "2", kMaxBonded, tilt.bonded),
          number_key("rate_deg_s", "2", above(0, 10), tilt.rate_deg_s),
          number_key("start_deg", "0", from_to_below(0, kSteepest_deg), tilt.start_deg)};
}

double cost_of_tilt_s(const Model& model, const Protocol& protocol) {
  constexpr double kSpeed_m_s = 1, kRun_s = .7;
  const int bonded = std::get<TiltProtocol>(protocol).bonded;
  return step_on_wall_s(model, bonded) * kRun_s / rolling_timestep_s(model, kSpeed_m_s);
}

}  // namespace

/// It depends on the sliding friction alone: rolling friction from .04 to .3 moved the angle by .03
/// degrees, restitution by less than .001.
ExperimentEntry tilt_entry() {
  return {.experiment = Experiment::tilt,
          .name = "tilt",
          .unit = "deg",
          .value_name = "angle of sliding",
          .description =
              "Two or more grains, glued side by side so that none can roll, lie on the plate "
              "while it is tilted slowly, until they slide.",
          .readings = {{"half_mm_slip_deg", "deg"}, {"begin_deg", "deg"}},
          .coefficients = {kWallSliding},
          .tells = kWallSliding,
          .sheet = {.test = "sliding", .value = "angle_deg"},
          .is_stochastic = false,
          .is_filmed = true,
          // A hand or a worn motor does not keep it, and the angle hardly depends on it.
          .filmed_settings = {{"rate_deg_s", "rate_deg_s", .2}},
          .usual_scatter = .1,
          .usual = TiltProtocol{},
          .keys = keys_of_tilt,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_tilt(model, std::get<TiltProtocol>(protocol), seed, report, record);
              },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(0, 90); },
          .cost_s = cost_of_tilt_s};
}

}  // namespace repose::dem
