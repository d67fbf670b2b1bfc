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

double height_between(const EdgePoint& a, const EdgePoint& b, double out) {
  if (b.out <= a.out) return b.height;
  return a.height + (out - a.out) / (b.out - a.out) * (b.height - a.height);
}

/// Columns are narrow enough for their number not to matter.
/// @param from, to  outwards
double line_angle_rad(std::span<const EdgePoint> edge, double from, double to) {
  constexpr int kColumns = 4000;
  double covariance = 0;
  double variance = 0;
  auto after = edge.begin() + 1;
  for (int i = 0; i < kColumns; ++i) {
    const double aside = (i + 0.5) / kColumns - 0.5;
    const double out = from + (aside + 0.5) * (to - from);
    while (after < edge.end() - 1 && after->out < out) ++after;
    covariance += aside * height_between(*(after - 1), *after, out);
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
