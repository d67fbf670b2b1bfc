#pragma once

#include <numbers>

namespace repose {

/// One degree in radians.
inline constexpr double kDegree = std::numbers::pi / 180;

inline double to_degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

/// The standard acceleration of free fall (CGPM 1901).
inline constexpr double kStandardGravity_m_s2 = 9.80665;

inline constexpr double kMmPerM = 1e3;
inline constexpr double kMsPerS = 1e3;
inline constexpr double kMPerMm = 1e-3;

}  // namespace repose
