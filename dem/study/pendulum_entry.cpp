#include "dem/experiment/model_setup.h"
#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_pendulum(Protocol& protocol) {
  auto& pendulum = std::get<PendulumProtocol>(protocol);
  return {length_key("string_mm", "300", pendulum.string_m),
          number_key("release_deg", "30", above(0, 90), pendulum.release_deg),
          count_key("pairs", "10", kMaxGrains / 2, pendulum.pairs)};
}

double cost_of_pendulum_s(const Model& /*model*/, const Protocol& protocol) {
  return kImpact_s * std::get<PendulumProtocol>(protocol).pairs;
}

}  // namespace

ExperimentEntry pendulum_entry() {
  return {.experiment = Experiment::pendulum,
          .name = "pendulum",
          .unit = "deg",
          .value_name = "swing of the struck grain",
          .description =
              "Two grains hang on strings, side by side; one is drawn aside, let go, and strikes "
              "the other, which swings up.",
          .readings = {{"rise_mm", "mm"}, {"height_ratio", ""}, {"sd_deg", "deg"}},
          .coefficients = {kGrainRestitution, kGrainSliding, kGrainRolling},
          .tells = kGrainRestitution,
          .sheet = {.test = "pendulum",
                    .value = "swing_deg",
                    .protocol = {{"release_deg", "release_deg"}}},
          .is_default = false,
          .readings_per_run =
              [](const Protocol& protocol) { return std::get<PendulumProtocol>(protocol).pairs; },
          .softening_effect = "swings less far than one with the real stiffness",
          .usual = PendulumProtocol{},
          .keys = keys_of_pendulum,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_pendulum(model, std::get<PendulumProtocol>(protocol), seed, report,
                                    record);
              },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(0, 90); },
          .cost_s = cost_of_pendulum_s};
}

}  // namespace repose::dem
