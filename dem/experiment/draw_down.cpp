#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "dem/experiment/draw_down_boxes.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/heap_settling.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {
namespace {

constexpr double kLongestFlow_s = 60;
/// Shares of the run when the gate opens, and of the flow.
constexpr double kFilled = .35;
constexpr double kUsualFlow_s = 3;
/// What stays must be this many grain diameters high somewhere to be more than a layer.
constexpr double kLowestSlope = 1.5;
/// The last grains trickle: the flow is taken to be over when this much of it is through.
constexpr double kThrough = .95;
/// The steady part of the flow, which begins from rest and ends along slopes.
constexpr double kSteadyFrom = .1, kSteadyTo = .5;

/// What went through the slot.
struct Flow {
  std::vector<double> passed_s;  ///< since the gate opened, when each grain was below; ascending
  bool is_at_rest = true;
};

bool is_below(const Simulation& simulation, int grain, const DrawDownProtocol& protocol) {
  return simulation.grain(grain).position.z() < protocol.drop_m;
}

struct Boxes {
  Bulk above;
  Bulk below;

  int grains() const { return above.grains + below.grains; }
  double relative_mass() const { return above.relative_mass + below.relative_mass; }
};

Boxes boxes_of(const Simulation& simulation, const DrawDownProtocol& protocol) {
  Boxes boxes;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    (is_below(simulation, k, protocol) ? boxes.below : boxes.above).add(simulation, k);
  }
  return boxes;
}

/// Opens the gate and waits until all grains rest. A gate that is pulled away at a metre per second
/// is open before a grain has fallen by a few diameters: here it is gone at once.
Flow discharge(ExperimentRun& run, const DrawDownProtocol& protocol) {
  Simulation& simulation = run.simulation();
  simulation.remove_wall(kDrawDownGate);
  const double opened_s = simulation.time_s();
  RestTest rest(simulation.setup());
  Flow flow;
  double last_s = 0;
  while (!rest.is_at_rest(simulation)) {
    const double now_s = simulation.time_s() - opened_s;
    if (now_s > kLongestFlow_s) {
      throw NoReading(
          fmt::format("draw_down: grains still run out after {:g} s. Fix: a wider slot, or a lower "
                      "fill.",
                      kLongestFlow_s));
    }
    flow.is_at_rest = now_s <= last_s + kLongestSettling_s;
    if (!flow.is_at_rest) break;
    run.advance_for(rest.interval_s());
    const auto below = static_cast<std::size_t>(boxes_of(simulation, protocol).below.grains);
    if (below > flow.passed_s.size()) {
      last_s = simulation.time_s() - opened_s;
      flow.passed_s.resize(below, last_s);
    }
    run.report_progress(kFilled + (1 - kFilled) * now_s / (now_s + kUsualFlow_s));
  }
  return flow;
}

/// Why there is nothing to read, where that is so.
void check_flow(const ExperimentRun& run, const DrawDownProtocol& protocol, const Flow& flow) {
  const Simulation& simulation = run.simulation();
  const int grains = boxes_of(simulation, protocol).grains();
  double highest_above_m = 0;
  bool has_arch = flow.passed_s.empty();
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    if (is_below(simulation, k, protocol)) {
      if (highest_m(simulation, k) < protocol.drop_m) continue;
      throw NoReading(
          "draw_down: the lower heap reaches up to the slot and stops the flow. Fix: a greater "
          "drop_mm, or a lower fill_mm.");
    }
    highest_above_m = std::max(highest_above_m, highest_m(simulation, k));
    has_arch |= std::abs(simulation.grain(k).position.x()) < .25 * protocol.slot_m;
  }
  if (has_arch) {
    throw NoReading(
        fmt::format("draw_down: grains arch over the slot once {} of {} have run out. Fix: a wider "
                    "slot, or less friction.",
                    flow.passed_s.size(), grains));
  }
  const double layer_m = upper_floor_m(protocol) + kLowestSlope * diameter_m(run.shape());
  if (highest_above_m >= layer_m) return;
  throw NoReading(fmt::format(
      "draw_down: {} of {} grains run out, and no slope stays above. Fix: a longer box, "
      "a narrower slot, or more friction.",
      flow.passed_s.size(), grains));
}

/// When a fraction of what runs out was below the slot, s.
double time_of(const Flow& flow, double fraction) {
  const auto grain = std::ceil(fraction * static_cast<double>(flow.passed_s.size())) - 1;
  return flow.passed_s[static_cast<std::size_t>(std::max(0.0, grain))];
}

/// Grains a second while the flow is steady; none where it is too short for that.
std::optional<double> rate_s(const Flow& flow) {
  const double steady_s = time_of(flow, kSteadyTo) - time_of(flow, kSteadyFrom);
  const double grains = (kSteadyTo - kSteadyFrom) * static_cast<double>(flow.passed_s.size());
  return steady_s > 0 ? std::optional(grains / steady_s) : std::nullopt;
}

}  // namespace

Repeat run_draw_down(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                     const ProgressReport& report, const RunRecord& record) {
  ExperimentRun run = filled_boxes(model, protocol, seed, {report, record});
  const Flow flow = discharge(run, protocol);
  check_flow(run, protocol, flow);
  const Boxes boxes = boxes_of(run.simulation(), protocol);
  const double mean_grain_g = 1e3 * model.grain_material.density_kg_m3 * model.grain.volume_m3;
  std::optional<double> rate_g_s = rate_s(flow);
  if (rate_g_s) {
    *rate_g_s = mean_grain_g * *rate_g_s * (boxes.below.relative_mass / boxes.below.grains);
  }
  constexpr double kPercent = 100;
  return run.finish(kPercent * boxes.below.relative_mass / boxes.relative_mass(), seed,
                    {{"grains", boxes.grains()},
                     {"grains_out", boxes.below.grains},
                     {"filled_g", mean_grain_g * boxes.relative_mass()},
                     {"discharged_g", mean_grain_g * boxes.below.relative_mass},
                     {"time_s", time_of(flow, kThrough)},
                     {"rate_g_s", rate_g_s},
                     {"at_rest", flow.is_at_rest ? 1 : 0}});
}

}  // namespace repose::dem
