#include "tests/support/heap_fit.h"

#include <algorithm>
#include <cmath>

#include "tests/support/heap_draft.h"

namespace repose::testing {
namespace {

using vision::Point;
using vision::Segment;

/// Coordinates along the ground and up from it.
Point above_ground(const DrawnHeap& heap, Point p) {
  const double cosine = std::cos(heap.ground_tilt_rad);
  const double sine = std::sin(heap.ground_tilt_rad);
  const double x = p.x - heap.ground.from.x;
  const double y = p.y - heap.ground.from.y;
  return {x * cosine + y * sine, x * sine - y * cosine};
}

/// The true line determines the columns used, so that high and low grains count alike.
double fitted_rad(const DrawnHeap& heap, const Segment& line) {
  const Point low = above_ground(heap, line.from);
  const Point high = above_ground(heap, line.to);
  const auto column_at = [&](double height) {
    return low.x + (high.x - low.x) * (height * heap.height_px - low.y) / (high.y - low.y);
  };
  const double from = std::min(column_at(0.2), column_at(0.8));
  const double to = std::max(column_at(0.2), column_at(0.8));
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Point& point : heap.outline) {
    const Point p = above_ground(heap, point);
    if (p.x < from || p.x > to) continue;
    n += 1;
    sx += p.x;
    sy += p.y;
    sxx += p.x * p.x;
    sxy += p.x * p.y;
  }
  return std::atan(std::abs((n * sxy - sx * sy) / (n * sxx - sx * sx)));
}

}  // namespace

std::vector<double> outline_errors_rad(const DrawnHeap& heap) {
  std::vector<double> errors;
  if (heap.left_line) errors.push_back(fitted_rad(heap, *heap.left_line) - *heap.left_rad);
  if (heap.right_line) errors.push_back(fitted_rad(heap, *heap.right_line) - *heap.right_rad);
  return errors;
}

void settle(HeapScene& scene, Random& random) {
  constexpr int kTrials = 200;
  for (int i = 0; i < kTrials; ++i) {
    const auto errors = outline_errors_rad(heap_truth(scene));
    const auto is_small = [](double error) { return std::abs(error) < radians(0.15); };
    if (std::all_of(errors.begin(), errors.end(), is_small)) return;
    scene.seed = random.seed();
  }
}

}  // namespace repose::testing
