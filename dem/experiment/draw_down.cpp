#include "dem/experiment/draw_down.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/filling.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {

namespace {

/// Minimum number of grains across and along the height of a bulk.
constexpr double kFewestInBox = 4;
/// Minimum width of a slot, in grains. Source: To, Lai and Pak (2001), Jamming of granular flow in
/// a two-dimensional hopper, Physical Review Letters 86, 71: in two dimensions, which a slot
/// resembles most, outlets of at least five diameters hardly ever jam.
constexpr double kSlot = 5;
/// Allows for rounding of sizes converted from mm to m.
constexpr double kBoxRounding = 1e-9;
/// Thickness of the upper box's floor and the gate.
constexpr double kThickness_m = .002;

void check_sizes(const DrawDownProtocol& protocol, double grain_m, base::Faults& errors) {
  const auto at_least = [&](const char* name, double value, double least, const std::string& rule,
                            const char* fix) {
    errors.require(std::isfinite(value) && value >= (1 - kBoxRounding) * least,
                   {.subject = fmt::format("draw_down.{}", name),
                    .value = fmt::format("is {:g}", value),
                    .rule = fmt::format("{}, {:.4g} m or more", rule, least),
                    .fix = fmt::format("{}.", fix)});
  };
  at_least("slot_m", protocol.slot_m, kSlot * grain_m,
           fmt::format("{:g} grain lengths, or grains arch over it", kSlot), "a wider slot");
  at_least("depth_m", protocol.depth_m, kFewestInBox * grain_m,
           fmt::format("{:g} grain lengths, or the panes carry the slopes", kFewestInBox),
           "a deeper box");
  at_least("fill_m", protocol.fill_m, kFewestInBox * grain_m,
           fmt::format("{:g} grain lengths, or no slope is left to measure", kFewestInBox),
           "a higher fill");
  at_least("length_m", protocol.length_m, protocol.slot_m + 2 * kFewestInBox * grain_m,
           fmt::format("the slot and {:g} grain lengths on either side of it", kFewestInBox),
           "a longer box or a narrower slot");
  // A heap that spreads from wall to wall is as high as its share of the fill plus its own slope
  // over half a slot, which the two slopes above lack: at 45 degrees, this much.
  at_least("drop_m", protocol.drop_m, protocol.fill_m + .5 * protocol.slot_m,
           "the lower heap must not reach the slot: the fill and half the slot",
           "a greater drop or a lower fill");
}

void check(const Model& model, const DrawDownProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  check_sizes(protocol, 2 * largest_reach_m(model), errors);
  constexpr double kPacked = .65;
  const double box_m3 = protocol.length_m * protocol.depth_m * protocol.fill_m;
  const double grains = kPacked * box_m3 / model.grain.volume_m3;
  errors.require(
      !(grains > kMaxGrains),
      {.subject = "draw_down.length_m",
       .value = fmt::format("is {:g}, draw_down.depth_m {:g}, draw_down.fill_m {:g}: the upper box "
                            "holds about {:.2g} grains",
                            protocol.length_m, protocol.depth_m, protocol.fill_m, grains),
       .rule = fmt::format("at most {}", kMaxGrains),
       .fix = "a smaller box or a lower fill."});
  errors.throw_if_any();
}

/// An infinite vertical wall through a point, with the grains on its `inwards` side.
Wall pane(const Model& model, const Vector& point, const Vector& inwards) {
  return part_wall(
      model, WallPart::pane, Plane{},
      {.position = point, .orientation = Quaternion::FromTwoVectors(Vector::UnitZ(), inwards)});
}

/// A part of the upper box's floor.
Wall slab(const DrawDownProtocol& protocol, double from_x, double to_x) {
  return study_wall(
      Box{.half_size = {.5 * (to_x - from_x), .5 * protocol.depth_m, .5 * kThickness_m}},
      {.position = {.5 * (from_x + to_x), 0, protocol.drop_m + .5 * kThickness_m}});
}

std::vector<Wall> walls_of(const Model& model, const DrawDownProtocol& protocol) {
  const double end = .5 * protocol.length_m, side = .5 * protocol.depth_m;
  const double lip = .5 * protocol.slot_m;
  return {study_wall(Plane{}),
          pane(model, {-end, 0, 0}, Vector::UnitX()),
          pane(model, {end, 0, 0}, -Vector::UnitX()),
          pane(model, {0, -side, 0}, Vector::UnitY()),
          pane(model, {0, side, 0}, -Vector::UnitY()),
          slab(protocol, -end, -lip),
          slab(protocol, lip, end),
          slab(protocol, -lip, lip)};
}

/// Random places over the upper box.
RainPlan rain_of(const DrawDownProtocol& protocol, double reach_m) {
  const double along = protocol.length_m - 2 * reach_m;
  const double across = protocol.depth_m - 2 * reach_m;
  const auto place = [along, across](Random& random) {
    // Separate statements, as argument evaluation order is unspecified.
    const double x = along * (random.uniform() - .5);
    const double y = across * (random.uniform() - .5);
    return Vector(x, y, 0);
  };
  const double floor_m = upper_floor_m(protocol);
  return {.place = place, .floor_m = floor_m, .rim_m = floor_m + protocol.fill_m};
}

}  // namespace

double upper_floor_m(const DrawDownProtocol& protocol) { return protocol.drop_m + kThickness_m; }

BoxesFront front_of(const DrawDownProtocol& protocol) {
  return {.length_m = protocol.length_m,
          .upper_floor_m = upper_floor_m(protocol),
          .fill_m = protocol.fill_m,
          .drop_m = protocol.drop_m};
}

ExperimentRun filled_boxes(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                           const Observers& observers) {
  check(model, protocol);
  const RainPlan plan = rain_of(protocol, largest_reach_m(model));
  // The fastest fall from the top of the fill to the floor of the lower box.
  const double fastest_m_s = std::sqrt(2 * kStandardGravity_m_s2 * plan.rim_m);
  ExperimentRun run(Simulation(bulk_setup(model, walls_of(model, protocol), fastest_m_s)),
                    observers, AdaptiveTimestep(model, fastest_m_s));
  rain(run, plan, seed);
  for (const int grain : above_rim(run.simulation(), plan.rim_m)) run.simulation().remove(grain);
  return run;
}

namespace {

constexpr double kLongestFlow_s = 60;
/// Fraction of the run before the gate opens; usual duration of the flow.
constexpr double kFilled = .35;
constexpr double kUsualFlow_s = 3;
/// The remaining grains must be this many diameters high somewhere to be more than a layer.
constexpr double kLowestSlope = 1.5;
/// The last grains trickle: the flow counts as over when this fraction has passed.
constexpr double kThrough = .95;
/// The steady part of the flow, without the start from rest and the end along slopes.
constexpr double kSteadyFrom = .1, kSteadyTo = .5;

/// Flow through the slot.
struct Flow {
  std::vector<double> passed_s;  ///< times after opening at which each grain had passed; ascending
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

/// Opens the gate and waits until all grains rest. A gate pulled away at a metre per second is open
/// before a grain has fallen by a few diameters; here it disappears at once.
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
      throw NoMeasurement(
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

/// Throws NoMeasurement with the reason if there is nothing to measure.
void check_flow(const ExperimentRun& run, const DrawDownProtocol& protocol, const Flow& flow) {
  const Simulation& simulation = run.simulation();
  const int grains = boxes_of(simulation, protocol).grains();
  double highest_above_m = 0;
  bool has_arch = flow.passed_s.empty();
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    if (is_below(simulation, k, protocol)) {
      if (highest_m(simulation, k) < protocol.drop_m) continue;
      throw NoMeasurement(
          "draw_down: the lower heap reaches up to the slot and stops the flow. Fix: a greater "
          "drop_mm, or a lower fill_mm.");
    }
    highest_above_m = std::max(highest_above_m, highest_m(simulation, k));
    has_arch |= std::abs(simulation.grain(k).position.x()) < .25 * protocol.slot_m;
  }
  if (has_arch) {
    throw NoMeasurement(
        fmt::format("draw_down: grains arch over the slot once {} of {} have run out. Fix: a wider "
                    "slot, or less friction.",
                    flow.passed_s.size(), grains));
  }
  const double layer_m = upper_floor_m(protocol) + kLowestSlope * diameter_m(run.shape());
  if (highest_above_m >= layer_m) return;
  throw NoMeasurement(fmt::format(
      "draw_down: {} of {} grains run out, and no slope stays above. Fix: a longer box, "
      "a narrower slot, or more friction.",
      flow.passed_s.size(), grains));
}

/// Time at which a fraction of the discharge had passed the slot, s.
double time_of(const Flow& flow, double fraction) {
  const auto grain = std::ceil(fraction * static_cast<double>(flow.passed_s.size())) - 1;
  return flow.passed_s[static_cast<std::size_t>(std::max(0.0, grain))];
}

/// Grains per second during steady flow; std::nullopt if too short.
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

namespace {

std::vector<ProtocolKey> keys_of_draw_down(Protocol& protocol) {
  auto& draw_down = protocol.as<DrawDownProtocol>();
  return {length_key("length_mm", "500", draw_down.length_m),
          length_key("depth_mm", "150", draw_down.depth_m),
          length_key("slot_mm", "120", draw_down.slot_m),
          length_key("fill_mm", "150", draw_down.fill_m),
          length_key("drop_mm", "250", draw_down.drop_m)};
}

/// Scales the boxes with the slot that these grains need.
void adapt_draw_down(Protocol& protocol, const UsualBench& bench) {
  constexpr double kSlotGrains = 5.2, kStep_m = .005;
  const auto stepped = [](double size_m) { return kStep_m * std::ceil(size_m / kStep_m - 1e-9); };
  auto& boxes = protocol.as<DrawDownProtocol>();
  const double slot_m = stepped(kSlotGrains * kMPerMm * *std::ranges::max_element(bench.grain_mm));
  const double factor = slot_m / boxes.slot_m;
  boxes = {.length_m = stepped(factor * boxes.length_m),
           .depth_m = stepped(factor * boxes.depth_m),
           .slot_m = slot_m,
           .fill_m = stepped(factor * boxes.fill_m),
           .drop_m = stepped(factor * boxes.drop_m)};
}

double cost_of_draw_down_s(const Model& model, const Protocol& protocol) {
  // Filling, flow and coming to rest.
  constexpr double kPacked = .6, kSimulated_s = 4, kFallSpeed_m_s = 2;
  const auto& draw_down = protocol.as<DrawDownProtocol>();
  const double box_m3 = draw_down.length_m * draw_down.depth_m * draw_down.fill_m;
  const double grains = kPacked * box_m3 / model.grain.volume_m3;
  return bulk_step_s(model) * many_grains_factor(grains) * grains * kSimulated_s /
         bulk_timestep_s(model, kFallSpeed_m_s);
}

}  // namespace

ExperimentEntry draw_down_entry() {
  return {
      .name = "draw_down",
      .unit = "%",
      .value_name = "discharged mass",
      .description =
          "Grains in a box run out through a slot in its floor, into another box below it. "
          "What runs out is weighed, as a percentage of the fill.",
      .readings = {{"upper_angle_deg", "deg", true},
                   {"lower_angle_deg", "deg", true},
                   {"filled_g", "g", true},
                   {"discharged_g", "g", true},
                   {"time_s", "s", true},
                   {"rate_g_s", "g/s"},
                   {"grains", ""},
                   {"grains_out", ""},
                   {"at_rest", ""}},
      .coefficients = {kWallRestitution, kWallSliding, kWallRolling, kGrainRestitution,
                       kGrainSliding, kGrainRolling},
      .parts = {WallPart::pane},
      .sheet = {.test = "draw_down",
                .value = "discharged_percent",
                .mean =
                    MeanOfReadings{.what = "mass that runs out, by that of the fill, times 100",
                                   .readable = between(0, 100),
                                   .quantity = "discharged_mass",
                                   .source = "mean of the discharges",
                                   .validity =
                                       "No material constant: it belongs to these boxes, filled to "
                                       "this height."}},
      .is_bulk = true,
      .is_default = false,
      .usual_model_error = .03,
      .usual = DrawDownProtocol{},
      .keys = keys_of_draw_down,
      .run = run_as<DrawDownProtocol, run_draw_down>,
      .adapt = adapt_draw_down,
      .front = [](const Protocol& protocol) { return front_of(protocol.as<DrawDownProtocol>()); },
      .fall_m =
          [](const ClumpShape& /*grain*/, const Protocol& protocol) {
            const auto& boxes = protocol.as<DrawDownProtocol>();
            return boxes.fill_m + boxes.drop_m;
          },
      .possible = [](const Model& /*model*/,
                     const Protocol& /*protocol*/) { return from_to(0, 100); },
      .cost_s = cost_of_draw_down_s};
}

}  // namespace repose::dem
