#include "tests/support/edge_angle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace repose::testing {
namespace {

constexpr double kFrom = 0.2;
constexpr double kTo = 0.8;

EdgePoint first_below(std::span<const EdgePoint> edge, double height) {
  for (std::size_t i = 1; i < edge.size(); ++i) {
    if (edge[i].height >= height || edge[i - 1].height < height) continue;
    const double t = (edge[i - 1].height - height) / (edge[i - 1].height - edge[i].height);
    return {.out = edge[i - 1].out + t * (edge[i].out - edge[i - 1].out), .height = height};
  }
  throw std::invalid_argument("the edge does not fall through the window");
}

double height_at(std::span<const EdgePoint> edge, double out) {
  const auto after = std::lower_bound(edge.begin() + 1, edge.end() - 1, out,
                                      [](const EdgePoint& p, double o) { return p.out < o; });
  const EdgePoint& from = *(after - 1);
  if (after->out <= from.out) return after->height;
  return from.height + (out - from.out) / (after->out - from.out) * (after->height - from.height);
}

/// Columns are so narrow that their number does not matter.
double line_angle_rad(std::span<const EdgePoint> edge, double from, double to) {
  constexpr int kColumns = 4000;
  double covariance = 0;
  double variance = 0;
  for (int i = 0; i < kColumns; ++i) {
    const double aside = (i + 0.5) / kColumns - 0.5;
    covariance += aside * height_at(edge, from + (aside + 0.5) * (to - from));
    variance += aside * aside;
  }
  return std::atan(-covariance / variance / (to - from));
}

}  // namespace

EdgeAngle angle_of_edge(std::span<const EdgePoint> edge, double heap_height,
                        std::span<const EdgePoint> smooth) {
  const auto ends = smooth.empty() ? edge : smooth;
  EdgeAngle found;
  found.high = first_below(ends, kTo * heap_height);
  found.low = first_below(ends, kFrom * heap_height);
  const double middle = (found.high.out + found.low.out) / 2;
  found.angle_rad = line_angle_rad(edge, found.high.out, found.low.out);
  found.bend_rad =
      line_angle_rad(edge, found.high.out, middle) - line_angle_rad(edge, middle, found.low.out);
  return found;
}

}  // namespace repose::testing
