#include "calibrate/statistics/regress/surface.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/statistics/regress/canonical.h"

namespace repose::calibrate {

namespace {

constexpr double kSignificant = .05;

std::string place_of(const Regression& regression, const SurfacePoint& point) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    parts.push_back(fmt::format("{} = {:.4g}", regression.factors[i].name, point.natural[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<double> responses_of(const Regression& regression) {
  std::vector<double> responses;
  for (const FittedRun& run : regression.runs) responses.push_back(run.response);
  return responses;
}

/// How well the same model fits the squares of the responses.
double r2_of_squares(const Regression& regression) {
  RunTable table;
  table.factors = regression.factors;
  table.levels.resize(table.factors.size());
  if (regression.blocks) table.blocks = regression.blocks->runs;
  for (const FittedRun& run : regression.runs) {
    for (std::size_t i = 0; i < table.factors.size(); ++i) {
      table.levels[i].push_back(table.factors[i].natural(run.coded[i]));
    }
    table.responses.push_back(run.response * run.response);
  }
  return regress(table, regression.model).r2;
}

/// The absolute value of an error has a kink where the error is 0. Its signs: no response is
/// negative; at least a fifth of them lie below a twentieth of the largest; and either the surface
/// undershoots 0 by more than the residual's standard deviation, or the model leaves a fifth less
/// of the scatter unexplained when the responses are squared, which removes a kink (if more than 1
/// % is unexplained at all). A smooth response that touches 0 shows neither.
bool looks_like_absolute_error(const Regression& regression, const SurfacePoint& lowest) {
  if (regression.is_exact) return false;
  constexpr double kNearZero = .05, kMany = .2, kMuchLess = .8;
  const std::vector<double> responses = responses_of(regression);
  const auto [least, greatest] = std::minmax_element(responses.begin(), responses.end());
  if (*least < 0) return false;
  const double limit = kNearZero * *greatest;
  const auto near_zero = std::count_if(responses.begin(), responses.end(),
                                       [&](double response) { return response <= limit; });
  if (static_cast<double>(near_zero) < kMany * static_cast<double>(responses.size())) return false;
  constexpr double kNoteworthy = .01;
  const double unexplained = 1 - regression.r2;
  return lowest.value < -regression.residual_sd ||
         (unexplained > kNoteworthy && 1 - r2_of_squares(regression) < kMuchLess * unexplained);
}

void diagnostic_response(const Regression& regression, const SurfacePoint& lowest,
                         base::FieldNames names, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (looks_like_absolute_error(regression, lowest)) {
    diagnostics.push_back(
        {"absolute_error",
         fmt::format("{} looks like an absolute error: it is never negative, many runs are close "
                     "to 0, and it seems to have a kink there, which no such surface can follow. "
                     "Fit the quantity itself, with its sign, and give the measured value as "
                     "{}.",
                     regression.response_name,
                     base::with_names(base::field("target value"), names))});
  }
  const std::vector<double> responses = responses_of(regression);
  if (*std::min_element(responses.begin(), responses.end()) >= 0 && lowest.value < 0) {
    diagnostics.push_back({"impossible_values",
                           fmt::format("The surface falls to {:.4g} (at {}), but no run gave less "
                                       "than 0: do not use it there.",
                                       lowest.value, place_of(regression, lowest))});
  }
}

void diagnostic_fit(const Regression& regression, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (regression.is_exact) {
    diagnostics.push_back({"exact_fit",
                           "The surface fits every run exactly: without residual scatter there are "
                           "no tests and no intervals."});
    return;
  }
  if (!regression.pure_error) {
    diagnostics.push_back({"no_repeats",
                           "No two runs have the same levels, so lack of fit cannot be tested. "
                           "Repeat the centre run."});
  }
  if (regression.lack_of_fit && regression.lack_of_fit->p.value_or(1) < kSignificant) {
    diagnostics.push_back(
        {"lack_of_fit",
         fmt::format("The model does not fit: its residual is larger than the scatter of "
                     "the repeats explains (p = {:.2g}). Use a higher-order model or a "
                     "smaller box.",
                     *regression.lack_of_fit->p)});
  }
  constexpr double kMuchLess = .2;
  if (!regression.r2_predicted || regression.r2_adjusted - *regression.r2_predicted > kMuchLess) {
    diagnostics.push_back(
        {"weak_prediction",
         fmt::format("Runs left out are predicted poorly (predicted R² {}, adjusted R² "
                     "{:.2f}): single runs determine the surface.",
                     regression.r2_predicted ? fmt::format("{:.2f}", *regression.r2_predicted)
                                             : "does not exist",
                     regression.r2_adjusted)});
  }
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    const auto p = regression.of_factor[i].p;
    if (!p || *p < kSignificant) continue;
    diagnostics.push_back(
        {"no_effect",
         fmt::format("{0} hardly depends on {1} (p = {2:.2g} for all of its terms): these "
                     "runs cannot determine {1}.",
                     regression.response_name, regression.factors[i].name, *p)});
  }
}

void diagnostic_blocks(const Regression& regression, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (!regression.blocks) return;
  const auto [least, greatest] = std::minmax_element(
      regression.blocks->effects.begin(), regression.blocks->effects.end(),
      [](const BlockEffect& a, const BlockEffect& b) { return a.value < b.value; });
  diagnostics.push_back(
      {"blocks",
       fmt::format("{} is shifted by {:.4g} from {} {} to {}. The surface and its intervals are "
                   "those of the mean of these blocks; a run in another block is shifted too, by "
                   "how much they do not say.",
                   regression.response_name, greatest->value - least->value,
                   regression.blocks->runs.name, least->label, greatest->label)});
}

std::string direction_text(const Regression& regression, const CanonicalAxis& axis) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axis.direction.size(); ++i) {
    parts.push_back(fmt::format("{:.2f} {}", axis.direction[i], regression.factors[i].name));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void diagnostic_optimum(const Regression& regression, const CanonicalForm& form,
                        std::vector<SurfaceDiagnostic>& diagnostics) {
  if (regression.is_exact) return;
  const auto is_certain = [](const CanonicalAxis& axis) { return axis.is_certain(); };
  if (std::none_of(form.axes.begin(), form.axes.end(), is_certain)) {
    diagnostics.push_back(
        {"no_curvature",
         "No curvature is significant: these runs show no optimum, and a model without "
         "squares may suffice."});
    return;
  }
  for (const CanonicalAxis& axis : form.axes) {
    if (is_certain(axis)) continue;
    diagnostics.push_back(
        {"ridge",
         fmt::format(
             "A ridge: along ({}) the curvature is {:.3g} ± {:.3g} and may be 0. There is no "
             "single optimum along it.",
             direction_text(regression, axis), axis.curvature, axis.uncertainty)});
  }
  if (form.shape == SurfaceShape::saddle) {
    diagnostics.push_back(
        {"saddle",
         "The stationary point is a saddle, neither minimum nor maximum: the lowest and "
         "highest points lie on the edge of the box, and there may be better ones "
         "beyond it."});
  }
}

void diagnostic_target(const Regression& regression, const BoxExtremes& extremes,
                       const TargetSet& target, std::vector<SurfaceDiagnostic>& diagnostics) {
  if (!target.is_reached) {
    diagnostics.push_back(
        {"target_not_reached",
         fmt::format("{:g} is not reached: within the box the surface ranges from "
                     "{:.4g} to {:.4g}. Move or widen the factors' ranges.",
                     target.target.value, extremes.least.value, extremes.greatest.value)});
    return;
  }
  const std::size_t factors = regression.factors.size();
  if (factors == 1) return;
  std::vector<std::string> open;
  for (std::size_t i = 0; i < factors; ++i) {
    const auto& ranges = target.ranges[i];
    if (ranges.size() == 1 && ranges.front() == regression.box[i]) {
      open.push_back(regression.factors[i].name);
    }
  }
  diagnostics.push_back(
      {"not_determined",
       fmt::format("One target cannot determine {} factors: a whole set of points meets it{}. "
                   "Measure something else as well, or fix factors at measured values.",
                   factors,
                   open.empty()
                       ? ""
                       : fmt::format(", and every level of {} is in it", fmt::join(open, ", ")))});
}

}  // namespace

std::vector<SurfaceDiagnostic> diagnostics_of(const Regression& regression,
                                              const std::optional<CanonicalForm>& form,
                                              const BoxExtremes& extremes,
                                              const std::optional<TargetSet>& target,
                                              base::FieldNames names) {
  std::vector<SurfaceDiagnostic> diagnostics;
  diagnostic_response(regression, extremes.least, names, diagnostics);
  diagnostic_fit(regression, diagnostics);
  diagnostic_blocks(regression, diagnostics);
  if (form) diagnostic_optimum(regression, *form, diagnostics);
  if (target) diagnostic_target(regression, extremes, *target, diagnostics);
  return diagnostics;
}

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using LowHigh = std::array<double, 2>;

/// Solves c + b t + a t^2 = 0. Without cancellation: Numerical Recipes, sec. 5.6.
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

/// Searches for the target value within the box.
class TargetSearch {
 public:
  TargetSearch(const Regression& regression, const WantedValue& target)
      : regression_(regression),
        surface_(surface_of(regression)),
        box_(regression.box),
        target_(target) {
    surface_.constant -= target.value;
  }

  /// A point of the set, on the line from the lowest to the highest; std::nullopt if there is none.
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
  /// surface is continuous, that is where the target lies between the extremes over the others.
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

  /// Lines along each factor, through a grid of `levels` levels of each of the others.
  std::vector<Crossing> grid(int levels) const {
    std::vector<Crossing> crossings;
    for (std::size_t factor = 0; factor < box_.size(); ++factor) {
      add_grid_lines(factor, 0, levels, centre(), crossings);
    }
    return crossings;
  }

 private:
  /// Whether the intervals of the surface at a point and of the target allow them to be equal.
  bool may_be_target(const VectorXd& point) const {
    const double half_width = point_at(regression_, point).uncertainty;
    return std::abs(surface_(point)) <= std::hypot(half_width, target_.uncertainty);
  }

  /// How far this extends along a factor from a crossing, down (-1) or up (1); std::nullopt: to the
  /// end of the box.
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
      // The box's own end is possible if its immediate neighbourhood is.
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
