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
  /// A random place for a grain's centre over the vessel; its height counts for nothing.
  std::function<Vector(Random&)> place;
  double floor_m = 0;                       ///< that the grains fall on
  double rim_m = 0;                         ///< up to where they are to lie
  std::optional<int> grains = {};           ///< as many, if as many fit; else as many as fit
  std::optional<double> spout_m = {};       ///< they fall from this height; else in a steady rain
  std::optional<double> grains_per_s = {};  ///< no more than that; else as fast as they fall
};

/// Of the impacts that the time step of a rain is chosen for.
double fastest_rain_m_s(double reach_m, std::optional<double> spout_m = {});

/// Fills a vessel that is tall enough for all that falls, and waits until the grains rest.
///
/// They rain in layers, each a little above what is there, in random poses and at random places no
/// nearer to each other than they can reach, until they are heaped over the rim; of `grains_per_s`
/// a layer has those that are due. An interrupted run without that goes on where it stood.
void rain(ExperimentRun& run, const RainPlan& plan, std::uint64_t seed);

/// Grains whose centres lie above the rim.
std::vector<int> above_rim(const Simulation& simulation, double rim_m);

/// For heaps that creep: with the lift, about the 8 s that a bench heap is given before its picture
/// is taken. In the tube it is enough too: the tube holds what creeps.
inline constexpr double kLongestSettling_s = 5;

/// Grains of a heap that are to come to rest, from now on, in a stage of HeapStage.
void begin_settling(ExperimentRun& run, int stage);

/// Waits for it, telling `share`; false when they still moved (creep) after 5 s.
bool settle(ExperimentRun& run, double fraction);

/// Drops all walls and grains together by `height_m` onto a base that does not give, so many times,
/// and lets the grains come to rest after each.
///
/// While they fall together nothing presses; then the walls stand still, and the grains meet them
/// with v = sqrt(2 g h), which is what is simulated. Left out: the vessel's own rebound, and the
/// springs of the contacts that unload during the fall (m g times an overlap, far below m g h).
/// Proved by Tapping.* in tests/dem.
void tap(ExperimentRun& run, int taps, double height_m);

/// The walls of the heap experiment, in this order.
inline constexpr int kHeapPlate = 0;
inline constexpr int kHeapTube = 1;

/// Of a tube that it rains or is poured into, until the heap lies.
AdaptiveTimestep pace_of_rain(const Model& model, std::optional<double> spout_m = {});

/// The tube on its plate, made taller to be heaped over, and empty.
///
/// Grains rain into it, or fall from a spout: its height over the plate, m.
ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m = {});

/// Pours grains into it until they are heaped over its rim, `protocol.tube_height_m`, and rest.
/// `filling` is empty, or was interrupted while it was filled.
void pour(ExperimentRun& filling, const HeapProtocol& protocol, std::uint64_t seed,
          std::optional<double> spout_m = {}, std::optional<double> grains_per_s = {});

/// The tube with what lies below its rim, its time set back to 0: grains whose centres lie higher
/// are off.
ExperimentRun struck_level(const ExperimentRun& filling, const Model& model,
                           const HeapProtocol& protocol, std::optional<double> spout_m = {});

/// The tube, full of grains at rest, its time set back to 0: poured and struck level.
///
/// Throws base::InputError when `protocol.grains` are more than fit.
ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed);

/// Mean height of the upper surface of spheres in an upright tube about the z axis, m: of the
/// highest sphere on each of many plumb lines, spread evenly over the tube, or of the floor z = 0
/// where a line meets none. What a ruler gives that is put down on the grains at many places.
/// Proved by FillingHeight.* in tests/dem/experiment_fill_test.cpp.
double filling_height_m(std::span<const ClumpSphere> spheres, double tube_diameter_m);

}  // namespace repose::dem
