#pragma once

#include <cmath>

#include "base/units.h"

namespace repose::cli {

/// For files: more digits than any camera resolves, without the noise of the conversion.
inline double rounded_degrees(double angle_rad) {
  return std::round(to_degrees(angle_rad) * 1e6) / 1e6;
}

}  // namespace repose::cli
