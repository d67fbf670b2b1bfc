#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dem/experiment/experiment_run.h"
#include "dem/experiment/random.h"

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

}  // namespace repose::dem
