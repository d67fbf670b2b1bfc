#pragma once

#include <cmath>
#include <numbers>

namespace repose::cli {

/// The inside of the program knows radians only.
inline double to_degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

/// For files: more digits than any camera resolves, without the noise of the conversion.
inline double rounded_degrees(double angle_rad) {
  return std::round(to_degrees(angle_rad) * 1e6) / 1e6;
}

}  // namespace repose::cli
