#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// A coordinate at whose bound a reading reaches its extreme.
struct Limit {
  std::size_t coordinate = 0;
  bool at_max = false;
};

/// The smallest or largest expected reading in the box.
struct Extreme {
  double reading = 0;
  double uncertainty = 0;
  std::vector<Limit> limits;
};

/// Found from a spread of points and a search along the coordinates from the best of them.
Extreme extreme_of(const Surrogate& surrogate, std::size_t dimensions, bool largest);

/// What a reader of the fit has to know: assumptions, targets out of reach, unreliable surrogates.
std::vector<std::string> warnings_for(const Problem& problem, const Solution& solution,
                                      const JointFit& fit);

}  // namespace repose::calibrate
