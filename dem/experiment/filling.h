#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// How a vessel is filled, whatever its shape.
struct RainPlan {
  /// A random place for a grain's centre over the vessel; its height is ignored.
  std::function<Vector(Random&)> place;
  double floor_m = 0;                       ///< where the grains land
  double rim_m = 0;                         ///< target level of the grains
  std::optional<int> grains = {};           ///< this many, if they fit; else as many as fit
  std::optional<double> spout_m = {};       ///< height they fall from; else a steady rain
  std::optional<double> grains_per_s = {};  ///< maximum rate; else as fast as they fall
};

/// Impact speed that the time step of a rain is chosen for.
double fastest_rain_m_s(double reach_m, std::optional<double> spout_m = {});

/// Fills a vessel that is tall enough for all grains, and waits until they rest.
///
/// They rain in layers, each just above the grains already there, in random poses and at random
/// places where they cannot touch each other, until they heap over the rim; with `grains_per_s`, a
/// layer holds those due. An interrupted run resumes where it stopped, unless it has
/// `grains_per_s`.
void rain(ExperimentRun& run, const RainPlan& plan, std::uint64_t seed);

/// Grains whose centres lie above the rim.
std::vector<int> above_rim(const Simulation& simulation, double rim_m);

/// Limit for creeping heaps: with the lift, about the 8 s after which a real heap is photographed.
/// It suffices in the tube, too, which confines the grains.
inline constexpr double kLongestSettling_s = 5;

/// Starts waiting for rest, in a stage of HeapStage.
void begin_settling(ExperimentRun& run, int stage);

/// Waits for rest, reporting `fraction`; false if the grains still moved (creep) after 5 s.
bool settle(ExperimentRun& run, double fraction);

/// Drops all walls and grains together by `height_m` onto a rigid base, `taps` times, and lets the
/// grains come to rest after each.
///
/// During the fall there are no contact forces; then the walls stop, and the grains hit them with
/// v = sqrt(2 g h), which is simulated. Neglected: the vessel's own rebound, and the unloading of
/// the contact springs during the fall (m g times an overlap, far below m g h). Proved by Tapping.*
/// in tests/dem.
void tap(ExperimentRun& run, int taps, double height_m);

/// The walls of the heap experiment, in this order.
inline constexpr int kHeapPlate = 0;
inline constexpr int kHeapTube = 1;

/// Time stepping for a tube that is filled by rain or from a spout, until the heap is at rest.
AdaptiveTimestep pace_of_rain(const Model& model, std::optional<double> spout_m = {});

/// The empty tube on its plate, made taller so that it can be overfilled.
///
/// `spout_m`: height of the spout above the plate, m; std::nullopt: grains rain in.
ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m = {});

/// Pours grains in until they heap over the rim, `protocol.tube_height_m`, and rest. `filling` is
/// an empty tube, or one interrupted during filling.
void pour(ExperimentRun& filling, const HeapProtocol& protocol, std::uint64_t seed,
          std::optional<double> spout_m = {}, std::optional<double> grains_per_s = {});

/// The tube after removing grains whose centres lie above its rim; time is reset to 0.
ExperimentRun struck_level(const ExperimentRun& filling, const Model& model,
                           const HeapProtocol& protocol, std::optional<double> spout_m = {});

/// The tube full of grains at rest, poured and struck level; time is reset to 0.
///
/// Throws base::InputError if `protocol.grains` do not fit, unless allow_partial_fill is set.
ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed);

/// Mean height of the upper surface of spheres in an upright tube about the z axis, m: of the
/// highest sphere on each of many vertical lines, spread evenly over the tube, or of the floor
/// z = 0 if a line meets no sphere. Corresponds to ruler readings at many places. Proved by
/// FillingHeight.* in tests/dem/experiment_fill_test.cpp.
double filling_height_m(std::span<const ClumpSphere> spheres, double tube_diameter_m);

}  // namespace repose::dem
