#pragma once

#include "vision/compare/heap_comparison.h"

namespace repose::vision {

/// An angle and the half-width of its 95 % interval.
struct UncertainAngle {
  double angle_rad = 0;
  double uncertainty_rad = 0;
};

/// Difference, interval and verdict as described at AngleDifference; `same_measurement` as in
/// CompareOptions.
AngleDifference angle_difference(const UncertainAngle& first, const UncertainAngle& second,
                                 double margin_rad, bool same_measurement);

}  // namespace repose::vision
