#include "vision/compare/outline_scale.h"

#include <algorithm>
#include <cmath>

namespace repose::vision {
namespace {

/// Empty when the base that is known was not measured.
std::optional<double> metres_per_px(const ReposeAngle& measured, const PictureScale& scale) {
  if (scale.from == PictureScale::From::pixel) return scale.length_m;
  const auto shows_foot = [](const Flank& flank) {
    return flank.status == FlankStatus::ok && !flank.leaves_frame;
  };
  if (!shows_foot(measured.left) || !shows_foot(measured.right)) return std::nullopt;
  return scale.length_m / *measured.base_px;
}

/// Of the sides that are compared [px^2]; nothing when a foot is missing from one of them.
std::optional<double> compared_area(const Skyline& skyline, const Reach& reach) {
  double area = 0;
  const double from = std::min(0.0, skyline.front().along);
  const double to = std::max(0.0, skyline.back().along);
  const std::array stretches = {std::array{from, 0.0}, std::array{0.0, to}};
  for (const std::size_t side : {0, 1}) {
    if (reach.cover[side] == Cover::part) return std::nullopt;
    if (reach.cover[side] == Cover::none) continue;
    area += difference_of(skyline, skyline, stretches[side][0], stretches[side][1]).covered;
  }
  if (area <= 0) return std::nullopt;
  return area;
}

}  // namespace

OutlineScale outline_scale(const std::array<const ReposeAngle*, 2>& measured,
                           const std::array<Skyline, 2>& skylines, const Reach& reach,
                           const CompareOptions& options) {
  if (options.scale[0] && options.scale[1]) {
    const auto first = metres_per_px(*measured[0], *options.scale[0]);
    const auto second = metres_per_px(*measured[1], *options.scale[1]);
    if (first && second) return {LengthUnit::metre, {*first, *second}};
  }
  const auto first = compared_area(skylines[0], reach);
  const auto second = compared_area(skylines[1], reach);
  if (first && second) {
    return {LengthUnit::root_area, {1 / std::sqrt(*first), 1 / std::sqrt(*second)}};
  }
  return {LengthUnit::height, {1 / *measured[0]->height_px, 1 / *measured[1]->height_px}};
}

}  // namespace repose::vision
