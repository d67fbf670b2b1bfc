#include "calibrate/fit/family.h"

#include <algorithm>
#include <limits>

namespace repose::calibrate {
namespace {

constexpr std::size_t kMost = 8;
constexpr double kDistinct = .2;  // distance in the unit box

double distance2(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

std::vector<Minimum> within_limit(const Solution& solution) {
  std::vector<Minimum> all;
  const auto add = [&](const Minimum& minimum) {
    if (minimum.chi2 <= solution.best.chi2 + kChi2Limit) all.push_back(minimum);
  };
  for (const Profile& profile : solution.profiles) {
    for (const Minimum& minimum : profile.minima) add(minimum);
  }
  for (const Point& point : solution.sets.points) add({point, solution.misfit.chi2(point), 0});
  return all;
}

}  // namespace

bool are_alike(const Point& a, const Point& b) { return distance2(a, b) < kDistinct * kDistinct; }

std::vector<Minimum> equivalence_family(const Solution& solution) {
  const std::vector<Minimum> candidates = within_limit(solution);
  std::vector<double> distance(candidates.size(), std::numeric_limits<double>::infinity());
  const auto keep_away_from = [&](const Point& point) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], distance2(candidates[i].point, point));
    }
  };
  keep_away_from(solution.best.point);
  std::vector<Minimum> family;
  while (family.size() < kMost) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (farthest == distance.end() || *farthest < kDistinct * kDistinct) break;
    family.push_back(candidates[static_cast<std::size_t>(farthest - distance.begin())]);
    keep_away_from(family.back().point);
  }
  return family;
}

}  // namespace repose::calibrate
