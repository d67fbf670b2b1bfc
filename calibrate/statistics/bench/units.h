#pragma once

#include "base/units.h"

namespace repose::calibrate {

constexpr double kM3PerMl = 1e-6;
constexpr double kKgPerG = 1e-3;
constexpr double kRightAngle_deg = 90;

/// A bound that 0 itself is above.
constexpr double kFromZero = -1e-300;

}  // namespace repose::calibrate
