#include "dem/experiment/heap_fill.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/rain.h"

namespace repose::dem {
namespace {

/// How much taller the tube is made for the filling, in reaches of a grain.
constexpr double kTaller = 40;

Wall plate_of(const HeapProtocol& protocol) {
  const double half = .5 * protocol.plate_m;
  const double half_thickness = .5 * protocol.plate_thickness_m;
  return study_wall(Box{.half_size = {half, half, half_thickness}},
                    {.position = {0, 0, -half_thickness}});
}

Wall tube_of(const Model& model, const HeapProtocol& protocol, double height_m) {
  return part_wall(model, WallPart::tube,
                   Tube{.inner_radius = .5 * protocol.tube_diameter_m,
                        .thickness = protocol.tube_thickness_m,
                        .height = height_m});
}

/// Places over the tube.
RainPlan rain_of(const HeapProtocol& protocol, double reach_m, std::optional<double> spout_m,
                 std::optional<double> grains_per_s) {
  const double room = .5 * protocol.tube_diameter_m - reach_m;
  const auto place = [room](Random& random) {
    const double radius = room * std::sqrt(random.uniform());
    const double turn = 2 * std::numbers::pi * random.uniform();
    return Vector(radius * std::cos(turn), radius * std::sin(turn), 0);
  };
  return {.place = place,
          .rim_m = protocol.tube_height_m,
          .grains = protocol.grains,
          .spout_m = spout_m,
          .grains_per_s = grains_per_s};
}

/// The grains up to the rim, and their contacts but those with the tube above it.
Checkpoint levelled(const HeapProtocol& protocol, const Simulation& filled) {
  Checkpoint now = filled.checkpoint();
  now.step = 0;
  now.equal_steps = {};
  for (const int grain : above_rim(filled, protocol.tube_height_m)) {
    now.is_present[static_cast<std::size_t>(grain)] = false;
  }
  std::erase_if(now.contacts, [&](const ContactState& contact) {
    const auto a = static_cast<std::size_t>(contact.grain_a);
    if (!now.is_present[a]) return true;
    if (contact.grain_b >= 0) return !now.is_present[static_cast<std::size_t>(contact.grain_b)];
    const bool is_tube = -1 - contact.grain_b == kHeapTube;
    return is_tube &&
           highest_m(shape_of(filled, now.grains[a]), now.grains[a]) > protocol.tube_height_m;
  });
  return now;
}

}  // namespace

Pace pace_of_rain(const Model& model, std::optional<double> spout_m) {
  return {model, fastest_rain_m_s(largest_reach_m(model), spout_m)};
}

ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m) {
  const double reach = largest_reach_m(model);
  const double tall = protocol.tube_height_m + kTaller * reach;
  return {Simulation(bulk_setup(model, {plate_of(protocol), tube_of(model, protocol, tall)},
                                fastest_rain_m_s(reach, spout_m))),
          observers, pace_of_rain(model, spout_m)};
}

void pour(ExperimentRun& filling, const HeapProtocol& protocol, std::uint64_t seed,
          std::optional<double> spout_m, std::optional<double> grains_per_s) {
  const double reach = reach_m(filling.simulation().setup());
  rain(filling, rain_of(protocol, reach, spout_m, grains_per_s), seed);
}

ExperimentRun struck_level(const ExperimentRun& filling, const Model& model,
                           const HeapProtocol& protocol, std::optional<double> spout_m) {
  const double reach = largest_reach_m(model);
  SimulationSetup setup =
      bulk_setup(model, {plate_of(protocol), tube_of(model, protocol, protocol.tube_height_m)},
                 fastest_rain_m_s(reach, spout_m));
  // Grains that fall off the plate are gone once they are well below it.
  setup.floor_m = -protocol.plate_thickness_m - 5 * reach;
  return {Simulation(std::move(setup), levelled(protocol, filling.simulation())),
          filling.observers(),
          pace_of_rain(model, spout_m),
          {.work = filling.progress().work}};
}

ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed) {
  pour(filling, protocol, seed);
  const auto over = above_rim(filling.simulation(), protocol.tube_height_m).size();
  if (protocol.grains && !protocol.may_be_fewer && over > 0) {
    throw base::InputError(
        {.subject = "heap.grains",
         .value = fmt::format("is {}", *protocol.grains),
         .rule = fmt::format("at most what fits into the tube, {}",
                             static_cast<std::size_t>(filling.simulation().grain_count()) - over),
         .fix = "fewer grains, a taller or wider tube, or leave the number out to fill it."});
  }
  return struck_level(filling, model, protocol);
}

}  // namespace repose::dem
