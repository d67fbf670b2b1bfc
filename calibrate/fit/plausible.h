#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// Sets of parameters that the data leave plausible, distributed according to their probability.
struct PosteriorSamples {
  std::vector<Point> points;  ///< of density exp(-chi2 / 2) in the box
  std::vector<Point> wide;    ///< of density exp(-chi2 / 8): twice as far out
};

/// Sequential Monte Carlo: evenly spread points are weighted, resampled and moved while the weight
/// of the misfit is raised gradually. Del Moral, Doucet, Jasra (2006), J. R. Stat. Soc. B 68, 411;
/// the moves are ter Braak's (2006), Stat. Comput. 16, 239: along differences of other points.
/// Proved by Plausible.* in tests/calibrate.
PosteriorSamples posterior_samples(const Misfit& misfit, std::uint64_t seed);

/// Mean and standard deviation of each coordinate.
Point mean_of(const std::vector<Point>& points);
Point sd_of(const std::vector<Point>& points);

}  // namespace repose::calibrate
