#pragma once

#include <numbers>

namespace repose {

/// In radians: what an angle in degrees is multiplied by.
inline constexpr double kDegree = std::numbers::pi / 180;

inline constexpr double kMmPerM = 1e3;
inline constexpr double kMsPerS = 1e3;
inline constexpr double kMPerMm = 1e-3;

}  // namespace repose
