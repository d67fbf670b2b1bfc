#include "vision/compare/angle_difference.h"

#include <cmath>

namespace repose::vision {
namespace {

Agreement verdict_of(const std::array<double, 2>& interval, double margin) {
  const auto [low, high] = interval;
  if (low >= -margin && high <= margin) return Agreement::equivalent;
  return low > 0 || high < 0 ? Agreement::different : Agreement::cannot_tell;
}

}  // namespace

AngleDifference angle_difference(const UncertainAngle& first, const UncertainAngle& second,
                                 double margin_rad, bool same_measurement) {
  AngleDifference result;
  result.difference_rad = first.angle_rad - second.angle_rad;
  const double half_width =
      same_measurement ? 0 : std::hypot(first.uncertainty_rad, second.uncertainty_rad);
  result.interval_rad = {result.difference_rad - half_width, result.difference_rad + half_width};
  result.verdict = verdict_of(result.interval_rad, margin_rad);
  return result;
}

}  // namespace repose::vision
