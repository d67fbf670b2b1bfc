#pragma once

#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// Each observable along each parameter that its experiment depends on.
std::vector<ResponseCurve> response_curves(const Problem& problem, const Solution& solution);

/// Each observable over each pair of such parameters.
std::vector<ResponseSurface> response_surfaces(const Problem& problem, const Solution& solution);

}  // namespace repose::calibrate
