#pragma once

#include <vector>

namespace repose::calibrate {

/// A place in the unit box: parameters as fractions of the way from min to max.
using Point = std::vector<double>;

}  // namespace repose::calibrate
