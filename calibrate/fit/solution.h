#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/profile.h"

namespace repose::calibrate {

/// Everything that the fit found, in the unit box.
struct Solution {
  Misfit misfit;
  Minimum best;
  PlausibleSets sets;
  std::vector<Profile> profiles;  ///< per coordinate
  /// Least chi-square with the model's error as known beforehand, and its degrees of freedom.
  double stated_chi2 = 0;
  Freedom stated_freedom;
};

/// Learns the surrogates, finds the best fit, and follows it along every coordinate; begins again
/// where that comes upon a better one. Where the model has to be more wrong than was said, it is.
/// `runs` in_order.
Solution solve(const Problem& problem, const std::vector<Run>& runs);

}  // namespace repose::calibrate
