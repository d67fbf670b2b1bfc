#include "tests/bench/outline_angles.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "tests/support/edge_angle.h"
#include "vision/measure/geometry.h"
#include "vision/measure/outline_angle.h"

namespace repose::bench {

namespace {

vision::Outline above_ground(const render::Truth& truth) {
  const auto& [from, to] = truth.ground.value();
  const double slope = (to.y - from.y) / (to.x - from.x);
  const vision::GroundFrame ground({.y_at_0 = from.y - slope * from.x, .slope = slope});
  vision::Outline outline;
  for (const vision::Point& point : truth.outline) {
    outline.along.push_back(ground.along(point));
    outline.height.push_back(ground.height(point));
  }
  return outline;
}

/// Moving means of the heights over `width` points, fewer at the ends.
std::vector<double> smoothed(const std::vector<double>& heights, std::size_t width) {
  std::vector<double> means;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::size_t reach = std::min({width / 2, i, heights.size() - 1 - i});
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(i);
    const auto side = static_cast<std::ptrdiff_t>(reach);
    means.push_back(std::accumulate(middle - side, middle + side + 1, 0.0) /
                    static_cast<double>(2 * reach + 1));
  }
  return means;
}

/// One side, from the crest outwards.
std::vector<testing::EdgePoint> side_of(const std::vector<double>& along,
                                        const std::vector<double>& heights, double crest,
                                        double outwards) {
  std::vector<testing::EdgePoint> side;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double out = outwards * (along[i] - crest);
    if (out >= 0) side.push_back({.out = out, .height = heights[i]});
  }
  if (outwards < 0) std::reverse(side.begin(), side.end());
  return side;
}

}  // namespace

FlankAngles defined_angles(const render::Truth& truth, double grain_px) {
  const auto [along, heights] = above_ground(truth);
  const double spacing = (along.back() - along.front()) / static_cast<double>(along.size() - 1);
  const auto smooth = smoothed(heights, static_cast<std::size_t>(grain_px / spacing));
  const auto highest = std::max_element(smooth.begin(), smooth.end());
  const double crest = along[static_cast<std::size_t>(highest - smooth.begin())];
  const auto angle_rad = [&](double outwards) {
    return testing::angle_of_edge(side_of(along, heights, crest, outwards), *highest,
                                  side_of(along, smooth, crest, outwards))
        .angle_rad;
  };
  return {.left_rad = angle_rad(-1), .right_rad = angle_rad(1)};
}

FlankAngles outline_angles(const render::Truth& truth, double grain_px) {
  const vision::Outline outline = above_ground(truth);
  const vision::OutlineAngle angle = vision::measure_outline(outline, {.grain = grain_px});
  if (!angle.left || !angle.right) throw std::logic_error("a heap without a flank");
  return {.left_rad = angle.left->angle_rad, .right_rad = angle.right->angle_rad};
}

}  // namespace repose::bench
