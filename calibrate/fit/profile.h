#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// Chi-squared of one degree of freedom at 95 %: what a profile may rise to inside the interval.
inline constexpr double kChi2Limit = 3.841458820694124;

/// The best fit as a function of one coordinate.
struct Profile {
  std::vector<Minimum> minima;  ///< by rising coordinate, the best fit among them
  double low = 0;               ///< the interval, in the unit box
  double high = 1;
};

/// Follows the best fit with coordinate `held` moved to both sides until chi2 has risen by
/// kChi2Limit or a bound is met: Venzon and Moolgavkar (1988), Appl. Statist. 37, 87. `plausible`
/// points start searches of their own and, where they are within the limit, belong to the interval
/// even if the way to them is not. Proved by JointFit.* in tests/calibrate.
Profile profile_along(const Misfit& misfit, const Minimum& best, std::size_t held,
                      const std::vector<Point>& plausible);

}  // namespace repose::calibrate
