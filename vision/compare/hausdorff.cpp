#include "vision/compare/hausdorff.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace repose::vision {
namespace {

constexpr int kSteps = 2000;
constexpr double kMostOfIt = 0.95;

double step_between(const OutlinePoint& p, const OutlinePoint& q) {
  return std::hypot(q.along - p.along, q.height - p.height);
}

/// Points at equal steps along the edge, both ends included.
Skyline walked(const Skyline& edge) {
  double length = 0;
  for (std::size_t i = 1; i < edge.size(); ++i) length += step_between(edge[i - 1], edge[i]);
  if (length <= 0) return {edge.front()};
  Skyline walk;
  double behind = 0;  // length of the edge before point i
  std::size_t i = 1;
  for (int step = 0; step <= kSteps; ++step) {
    const double target = length * step / kSteps;
    double piece = step_between(edge[i - 1], edge[i]);
    while (i + 1 < edge.size() && behind + piece < target) {
      behind += piece;
      ++i;
      piece = step_between(edge[i - 1], edge[i]);
    }
    const double fraction = piece > 0 ? std::min(1.0, (target - behind) / piece) : 0;
    const OutlinePoint& p = edge[i - 1];
    const OutlinePoint& q = edge[i];
    walk.push_back(
        {p.along + fraction * (q.along - p.along), p.height + fraction * (q.height - p.height)});
  }
  return walk;
}

double squared_distance(const OutlinePoint& point, const OutlinePoint& p, const OutlinePoint& q) {
  const double x = q.along - p.along;
  const double y = q.height - p.height;
  const double length = x * x + y * y;
  const double along = (point.along - p.along) * x + (point.height - p.height) * y;
  const double fraction = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  const double dx = point.along - p.along - fraction * x;
  const double dy = point.height - p.height - fraction * y;
  return dx * dx + dy * dy;
}

/// Nearest distance to `edge`. Points are sorted by `along`, so the search goes outwards from the
/// point's own place and ends where the way along the ground alone is longer.
double distance_to(const Skyline& edge, const OutlinePoint& point) {
  if (edge.size() == 1) return step_between(point, edge.front());
  const auto above = std::lower_bound(
      edge.begin(), edge.end(), point.along,
      [](const OutlinePoint& candidate, double along) { return candidate.along < along; });
  const auto start = std::clamp<std::ptrdiff_t>(above - edge.begin(), 1, std::ssize(edge) - 1);
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](std::ptrdiff_t i) {
    const auto at = static_cast<std::size_t>(i);
    nearest = std::min(nearest, squared_distance(point, edge[at - 1], edge[at]));
  };
  const auto is_near = [&](std::ptrdiff_t i) {
    const double way = edge[static_cast<std::size_t>(i)].along - point.along;
    return way * way < nearest;
  };
  look(start);
  for (std::ptrdiff_t i = start + 1; i < std::ssize(edge) && is_near(i - 1); ++i) look(i);
  for (std::ptrdiff_t i = start - 1; i > 0 && is_near(i); --i) look(i);
  return std::sqrt(nearest);
}

EdgeDistance directed(const Skyline& from, const Skyline& to) {
  std::vector<double> distances;
  for (const OutlinePoint& point : walked(from)) distances.push_back(distance_to(to, point));
  std::sort(distances.begin(), distances.end());
  const auto last = static_cast<double>(distances.size() - 1);
  return {distances.back(), distances[static_cast<std::size_t>(std::ceil(kMostOfIt * last))]};
}

}  // namespace

EdgeDistance edge_distance(const Skyline& a, const Skyline& b) {
  const EdgeDistance there = directed(a, b);
  const EdgeDistance back = directed(b, a);
  return {std::max(there.largest, back.largest), std::max(there.most_of_it, back.most_of_it)};
}

}  // namespace repose::vision
