#include "dem/experiment/model_setup.h"
#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_drop(Protocol& protocol) {
  auto& drop = std::get<DropProtocol>(protocol);
  ProtocolKey low = length_key("low_height_mm", "50", drop.low_height_m, "none");
  low.needs = low.name;
  return {length_key("height_mm", "500", drop.height_m),
          count_key("grains", "10", kMaxGrains, drop.grains), low};
}

/// From lying flat below to standing above, beside the height of the fall.
Range possible_drop(const Model& model, const Protocol& protocol) {
  const double height_m = std::get<DropProtocol>(protocol).height_m;
  return from_to(0, 1e3 * (height_m + 2 * model.grain.reach_m()));
}

double cost_of_drop_s(const Model& /*model*/, const Protocol& protocol) {
  const auto& drop = std::get<DropProtocol>(protocol);
  return kImpact_s * drop.grains * (drop.low_height_m ? 2 : 1);
}

}  // namespace

ExperimentEntry drop_entry() {
  return {.experiment = Experiment::drop,
          .name = "drop",
          .unit = "mm",
          .value_name = "rebound height",
          .description = "A grain falls on the flat plate.",
          .readings = {{"lowest_point_rise_mm", "mm", true},
                       {.name = "low_rebound_mm",
                        .unit = "mm",
                        .is_measurable = true,
                        .needs = "low_height_mm",
                        .has_own_trials = true},
                       {"above_first_touch_mm", "mm"},
                       {"sd_mm", "mm"},
                       {"never_rose", ""}},
          .coefficients = {kWallRestitution, kWallSliding, kWallRolling},
          .tells = kWallRestitution,
          .sheet = {.test = "restitution",
                    .value = "rebound_mm",
                    .protocol = {{"drop_mm", "height_mm"}}},
          .is_in_air = true,
          .is_filmed = true,
          .readings_per_run =
              [](const Protocol& protocol) { return std::get<DropProtocol>(protocol).grains; },
          .softening_effect = "rebounds less than one with the real stiffness",
          .usual_scatter = .2,
          .usual = DropProtocol{},
          .keys = keys_of_drop,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_drop(model, std::get<DropProtocol>(protocol), seed, report, record);
              },
          .possible = possible_drop,
          .cost_s = cost_of_drop_s};
}

}  // namespace repose::dem
