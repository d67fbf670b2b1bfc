#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// A coordinate that stops a reading from going further.
struct Limit {
  std::size_t coordinate = 0;
  bool at_max = false;
};

/// The least or the largest expected reading in the box.
struct Extreme {
  double reading = 0;
  double uncertainty = 0;
  std::vector<Limit> limits;
};

/// By a spread of points and a search along the coordinates from the best of them.
Extreme extreme_of(const Surrogate& surrogate, std::size_t dimensions, bool largest);

/// What a reader of the fit has to know: assumptions, targets out of reach, surrogates that are
/// little to be trusted.
std::vector<std::string> warnings_for(const Problem& problem, const Solution& solution,
                                      const JointFit& fit);

}  // namespace repose::calibrate
