#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/plan/foresight.h"

namespace repose::calibrate {

/// A parameter counts as one that would be determined when it is in this part of the materials. In
/// the others it lies too near to a bound for an interval that ends inside of it.
inline constexpr double kEnough = .8;

/// An experiment to be done, and what is known once it and those before it are.
struct PlannedStep {
  std::size_t experiment = 0;  ///< place in Foresight::prospects()
  Outlook outlook;
};

/// Of all sets of experiments that are yet to be done, the smallest that determines nearly as much
/// as all of them together: at least 97 % of the parts of materials of all parameters, each counted
/// up to kEnough. Of several as small, the one with the narrowest intervals. In the order in which
/// each gives most. Empty: nothing is gained by any.
std::vector<PlannedStep> smallest_set(const Foresight& foresight);

}  // namespace repose::calibrate
