#include <algorithm>
#include <cmath>

#include "calibrate/statistics/regress/box.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using LowHigh = std::array<double, 2>;

/// Where c + b t + a t^2 = 0. Without cancellation: Numerical Recipes, sec. 5.6.
std::vector<double> roots_of(double a, double b, double c) {
  if (a == 0) return b == 0 ? std::vector<double>{} : std::vector<double>{-c / b};
  const double square = b * b - 4 * a * c;
  if (!(square >= 0)) return {};
  const double q = -(b + std::copysign(std::sqrt(square), b)) / 2;
  if (q == 0) return {0};
  std::vector<double> roots = {q / a, c / q};
  if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  if (roots[0] == roots[1]) roots.pop_back();
  return roots;
}

/// Looks for the wanted value within the box.
class TargetSearch {
 public:
  TargetSearch(const Regression& regression, const WantedValue& target)
      : regression_(regression),
        surface_(surface_of(regression)),
        box_(regression.box),
        target_(target) {
    surface_.constant -= target.value;
  }

  /// A point of the set: on the way from the lowest to the highest point; none if there is none.
  std::optional<VectorXd> any_point() const {
    const VectorXd from = lowest_in_box(surface_, box_), to = lowest_in_box(-surface_, box_);
    if (surface_(from) > 0 || surface_(to) < 0) return std::nullopt;
    const VectorXd way = to - from;
    const double slope = surface_.gradient.dot(way) + 2 * from.dot(surface_.curvature * way);
    for (const double t : roots_of(way.dot(surface_.curvature * way), slope, surface_(from))) {
      if (t >= 0 && t <= 1) return VectorXd(from + t * way);
    }
    return surface_(from) > -surface_(to) ? from : to;  // the box only touches the target
  }

  /// Levels of a factor at which the others can be chosen so that the target is met. Since the
  /// surface is continuous, that is where it lies between the extremes over the others.
  std::vector<LowHigh> range_of(std::size_t factor, double known_level) const {
    const auto& [low, high] = box_[factor];
    constexpr std::size_t kManyFactors = 5;
    const int steps = box_.size() <= kManyFactors ? 200 : 40;
    std::vector<double> levels = {known_level};
    for (int k = 0; k <= steps; ++k) levels.push_back(low + (high - low) * k / steps);
    std::sort(levels.begin(), levels.end());
    std::vector<LowHigh> ranges;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (!is_possible(factor, levels[k], known_level)) continue;
      const bool follows = !ranges.empty() && ranges.back()[1] == levels[k - 1];
      if (follows) {
        ranges.back()[1] = levels[k];
      } else {
        ranges.push_back({levels[k], levels[k]});
      }
    }
    for (LowHigh& range : ranges) sharpen(factor, known_level, (high - low) / steps, range);
    return ranges;
  }

  /// Where the target is met on the line along a factor through a point.
  void add_crossings(std::size_t factor, const VectorXd& through,
                     std::vector<Crossing>& crossings) const {
    const auto i = static_cast<Index>(factor);
    VectorXd point = through;
    point[i] = 0;
    const double slope = surface_.gradient[i] + 2 * surface_.curvature.row(i).dot(point);
    for (const double level : roots_of(surface_.curvature(i, i), slope, surface_(point))) {
      if (level < box_[factor][0] || level > box_[factor][1]) continue;
      point[i] = level;
      Crossing crossing;
      crossing.factor = factor;
      crossing.point = point_at(regression_, point);
      crossing.interval = {end_of_interval(factor, point, -1), end_of_interval(factor, point, 1)};
      crossings.push_back(std::move(crossing));
    }
  }

  VectorXd centre() const {
    VectorXd point(static_cast<Index>(box_.size()));
    for (std::size_t i = 0; i < box_.size(); ++i) {
      point[static_cast<Index>(i)] = (box_[i][0] + box_[i][1]) / 2;
    }
    return point;
  }

  /// Lines along each factor, through a grid of `levels` levels of each other one.
  std::vector<Crossing> grid(int levels) const {
    std::vector<Crossing> crossings;
    for (std::size_t factor = 0; factor < box_.size(); ++factor) {
      add_grid_lines(factor, 0, levels, centre(), crossings);
    }
    return crossings;
  }

 private:
  /// Whether the surface's interval at a point and that of the target allow them to be the same.
  bool may_be_target(const VectorXd& point) const {
    const double half_width = point_at(regression_, point).uncertainty;
    return std::abs(surface_(point)) <= std::hypot(half_width, target_.uncertainty);
  }

  /// How far along a factor that goes on from a crossing, down (-1) or up (1); empty: to the box's
  /// end.
  std::optional<double> end_of_interval(std::size_t factor, VectorXd point, int direction) const {
    const auto i = static_cast<Index>(factor);
    const auto& [low, high] = box_[factor];
    constexpr int kSteps = 200, kHalvings = 40;
    const double step = direction * (high - low) / kSteps;
    double possible = point[i];
    do {
      point[i] = possible + step;
      if (point[i] < low || point[i] > high) return std::nullopt;
      if (may_be_target(point)) possible = point[i];
    } while (possible == point[i]);
    double impossible = point[i];
    for (int k = 0; k < kHalvings; ++k) {
      point[i] = (possible + impossible) / 2;
      (may_be_target(point) ? possible : impossible) = point[i];
    }
    return regression_.factors[factor].natural(possible);
  }

  bool is_possible(std::size_t factor, double level, double known_level) const {
    if (level == known_level) return true;
    Box others = box_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(factor));
    const Quadratic slice = surface_.with_fixed(static_cast<Index>(factor), level);
    if (others.empty()) return false;  // a single factor meets the target at single levels
    return slice(lowest_in_box(slice, others)) <= 0 && slice(lowest_in_box(-slice, others)) >= 0;
  }

  /// Bisection between the last possible level and the next one.
  void sharpen(std::size_t factor, double known_level, double step, LowHigh& range) const {
    constexpr int kHalvings = 30;
    for (const std::size_t end : {0U, 1U}) {
      double possible = range[end];
      double impossible = end == 0 ? std::max(possible - step, box_[factor][0])
                                   : std::min(possible + step, box_[factor][1]);
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = (possible + impossible) / 2;
        (is_possible(factor, middle, known_level) ? possible : impossible) = middle;
      }
      // The box's own end is possible if what is next to it is.
      const bool reaches = std::abs(possible - box_[factor][end]) < 1e-6 * step;
      range[end] = reaches ? box_[factor][end] : possible;
    }
  }

  void add_grid_lines(std::size_t factor, std::size_t next, int levels, VectorXd point,
                      std::vector<Crossing>& crossings) const {
    if (next == factor) ++next;
    if (next >= box_.size()) {
      add_crossings(factor, point, crossings);
      return;
    }
    for (int k = 0; k < levels; ++k) {
      point[static_cast<Index>(next)] =
          box_[next][0] + (box_[next][1] - box_[next][0]) * k / (levels - 1);
      add_grid_lines(factor, next + 1, levels, point, crossings);
    }
  }

  const Regression& regression_;
  Quadratic surface_;  // minus the target
  const Box& box_;
  WantedValue target_;
};

}  // namespace

TargetSet solve_target(const Regression& regression, const WantedValue& target) {
  const TargetSearch search(regression, target);
  TargetSet set;
  set.target = target;
  const std::optional<VectorXd> point = search.any_point();
  set.is_reached = point.has_value();
  if (!point) return set;
  const std::size_t factors = regression.factors.size();
  for (std::size_t i = 0; i < factors; ++i) {
    search.add_crossings(i, search.centre(), set.through_centre);
  }
  for (std::size_t i = 0; i < factors; ++i) {
    if (factors > 1) {
      set.ranges.push_back(search.range_of(i, (*point)[static_cast<Index>(i)]));
      continue;
    }
    std::vector<LowHigh>& levels = set.ranges.emplace_back();
    for (const Crossing& crossing : set.through_centre) {
      levels.push_back({crossing.point.coded[0], crossing.point.coded[0]});
    }
  }
  constexpr std::size_t kFewFactors = 4, kManyFactors = 6;
  constexpr int kFine = 5, kCoarse = 3;
  if (factors <= kManyFactors) set.grid = search.grid(factors <= kFewFactors ? kFine : kCoarse);
  return set;
}

}  // namespace repose::calibrate
