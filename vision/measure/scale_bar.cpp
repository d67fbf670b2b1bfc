#include "vision/measure/scale_bar.h"

#include <cmath>

namespace repose::vision {

Estimate mm_per_px(const ScaleBar& scale) {
  // Each end is pointed at within a pixel or so.
  constexpr double kPointing_px = 1;
  const double length_px =
      std::hypot(scale.line.to.x - scale.line.from.x, scale.line.to.y - scale.line.from.y);
  const double value = scale.length_mm / length_px;
  return {value, value * std::sqrt(2) * kPointing_px / length_px};
}

}  // namespace repose::vision
