#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// What a reader of the fit has to know: assumptions, targets out of reach, surrogates that are
/// little to be trusted.
std::vector<std::string> warnings_for(const Problem& problem, const Solution& solution,
                                      const JointFit& fit);

}  // namespace repose::calibrate
