#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// What a surrogate expected of fresh runs before it knew of them. In the observable's unit.
struct SurrogateCheck {
  std::string observable;
  double predicted = 0;
  double uncertainty = 0;  ///< standard uncertainty of that
  double simulated = 0;    ///< mean of the runs; NaN without any
  double chance = 0;       ///< that it is off by so much by chance; NaN likewise
  /// It is off by more than chance makes it in 5 % of all checks (Bonferroni over the observables),
  /// and by more than half of the uncertainty of measurement: less does not matter.
  bool misses = false;
};

/// The surrogates of a fit against fresh runs at its best values, which it has not seen.
std::vector<SurrogateCheck> check_surrogates(const Problem& problem, const JointFit& fit,
                                             const std::vector<Run>& runs);

}  // namespace repose::calibrate
