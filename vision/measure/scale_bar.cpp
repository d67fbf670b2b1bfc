#include "vision/measure/scale_bar.h"

#include <cmath>

#include <fmt/format.h>

namespace repose::vision {

std::optional<base::Fault> problem_of(const ScaleBar& scale) {
  const double length_px =
      std::hypot(scale.line.to.x - scale.line.from.x, scale.line.to.y - scale.line.from.y);
  // Written so that NaN fails.
  if (!(length_px >= kShortestBar_px)) {
    return base::Fault{.value = fmt::format("the points are {:.3g} pixels apart", length_px),
                       .rule = fmt::format("{:g} or more", kShortestBar_px)};
  }
  const double mm = scale.length_mm / length_px;
  if (mm >= kFinestScale_mm_per_px && mm <= kCoarsestScale_mm_per_px) return std::nullopt;
  return base::Fault{
      .value = fmt::format("{:.4g} mm for {:.4g} pixels are {:.3g} mm a pixel", scale.length_mm,
                           length_px, mm),
      .rule = fmt::format("{:g} to {:g}, since light resolves no less and no heap is that large",
                          kFinestScale_mm_per_px, kCoarsestScale_mm_per_px)};
}

std::optional<base::Fault> problem_in(const ScaleBar& scale, int width, int height) {
  for (const Point& point : {scale.line.from, scale.line.to}) {
    const bool is_inside = point.x >= 0 && point.y >= 0 && point.x <= width && point.y <= height;
    if (is_inside) continue;
    return base::Fault{.subject = "point of the scale",
                       .value = fmt::format("= {:g},{:g}", point.x, point.y),
                       .rule = fmt::format("must lie inside the {} x {} picture", width, height),
                       .fix = "count pixels from its top left corner, in the picture as it is."};
  }
  return std::nullopt;
}

Estimate mm_per_px(const ScaleBar& scale) {
  // Each end is marked to within about a pixel.
  constexpr double kPointing_px = 1;
  const double length_px =
      std::hypot(scale.line.to.x - scale.line.from.x, scale.line.to.y - scale.line.from.y);
  const double value = scale.length_mm / length_px;
  return {value, value * std::sqrt(2) * kPointing_px / length_px};
}

}  // namespace repose::vision
