#include "dem/experiment/draw_down_boxes.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/grain_limit.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rain.h"

namespace repose::dem {
namespace {

/// Grains across and upwards that a bulk has at least.
constexpr double kFewestInBox = 4;
/// Grains that a slot is wide at least. Source: To, Lai and Pak (2001), Jamming of granular flow in
/// a two-dimensional hopper, Physical Review Letters 86, 71: outlets of five diameters and more
/// hardly ever jam, in two dimensions, which a slot is nearest to.
constexpr double kSlot = 5;
/// Sizes in mm are rounded once they are in m.
constexpr double kBoxRounding = 1e-9;
/// Of the upper box's floor and the gate.
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
  // A heap that spreads from wall to wall is as high as its share of the fill and its own slope
  // over half a slot, which the two slopes above lack: at 45 degrees this much.
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

/// An upright wall without end through a point, that grains are in front of.
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

/// Places over the upper box.
RainPlan rain_of(const DrawDownProtocol& protocol, double reach_m) {
  const double along = protocol.length_m - 2 * reach_m;
  const double across = protocol.depth_m - 2 * reach_m;
  const auto place = [along, across](Random& random) {
    // In this order: the order of evaluation of arguments is not fixed.
    const double x = along * (random.uniform() - .5);
    const double y = across * (random.uniform() - .5);
    return Vector(x, y, 0);
  };
  const double floor_m = upper_floor_m(protocol);
  return {.place = place, .floor_m = floor_m, .rim_m = floor_m + protocol.fill_m};
}

}  // namespace

double upper_floor_m(const DrawDownProtocol& protocol) { return protocol.drop_m + kThickness_m; }

ExperimentRun filled_boxes(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                           const Observers& observers) {
  check(model, protocol);
  const RainPlan plan = rain_of(protocol, largest_reach_m(model));
  // The fastest fall from the top of the fill to the floor of the lower box.
  const double fastest_m_s = std::sqrt(2 * kStandardGravity_m_s2 * plan.rim_m);
  ExperimentRun run(Simulation(bulk_setup(model, walls_of(model, protocol), fastest_m_s)),
                    observers, Pace(model, fastest_m_s));
  rain(run, plan, seed);
  for (const int grain : above_rim(run.simulation(), plan.rim_m)) run.simulation().remove(grain);
  return run;
}

}  // namespace repose::dem
