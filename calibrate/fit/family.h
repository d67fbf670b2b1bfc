#pragma once

#include <vector>

#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// Points that fit as well as the best (chi2 within kChi2Limit) and lie far from it and from each
/// other, the farthest first; none where all such points are close together.
std::vector<Minimum> equivalence_family(const Solution& solution);

/// So close in the unit box that a family has one of them only.
bool are_alike(const Point& a, const Point& b);

}  // namespace repose::calibrate
