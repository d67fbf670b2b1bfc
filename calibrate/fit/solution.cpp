#include "calibrate/fit/solution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <ceres/ceres.h>

#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

namespace {

constexpr double kMinDegrees = 1;

constexpr double kMaxScale = 1024;  // a power of two: the search doubles

constexpr int kHalvings = 12;  // of the scale's logarithm: down to a thousandth

/// Smallest multiple of Observable::model_sd at which the readings differ from the model by no more
/// than chance and the model's error explain: 1 if they already do, if less than one degree of
/// freedom is left to test with, or if no reading has such an error. `best` is the minimum of the
/// misfit.
///
/// Formulae and reasons: THEORY.md, "The model's own error". Proved by ModelError.* in
/// tests/calibrate.
double model_error_scale(Misfit misfit, Minimum best) {
  // Chi-square less its mean, which is its degrees of freedom: Paule and Mandel (1982), J. Res.
  // Natl. Bur. Stand. 87, 377. It falls as the model is trusted less.
  const auto excess = [&](double scale) {
    misfit.scale_model_errors(scale);
    best = minimum_from(misfit, best.point);
    return best.chi2 - misfit.freedom(best.point).of_chi2;
  };
  if (!misfit.has_model_errors()) return 1;
  if (misfit.freedom(best.point).of_chi2 < kMinDegrees || excess(1) <= 0) return 1;
  double high = 2;
  while (high < kMaxScale && excess(high) > 0) high *= 2;
  double low = high / 2;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = std::sqrt(low * high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return high;
}

constexpr std::size_t kSearched = 256;
constexpr std::size_t kStarts = 12;

/// All residuals; every coordinate is a block of its own, so that any can be held fixed.
class AllResiduals : public ceres::CostFunction {
 public:
  explicit AllResiduals(const Misfit& misfit) : misfit_(misfit) {
    const Point middle(misfit.dimensions(), .5);
    set_num_residuals(static_cast<int>(misfit.residuals(middle, false).values.size()));
    mutable_parameter_block_sizes()->assign(misfit.dimensions(), 1);
  }

  bool Evaluate(double const* const* coordinates, double* values,
                double** jacobians) const override {
    Point point;
    for (std::size_t j = 0; j < misfit_.dimensions(); ++j) point.push_back(*coordinates[j]);
    const Residuals all = misfit_.residuals(point, jacobians != nullptr);
    std::copy(all.values.begin(), all.values.end(), values);
    for (std::size_t j = 0; jacobians != nullptr && j < point.size(); ++j) {
      if (jacobians[j] == nullptr) continue;
      for (std::size_t i = 0; i < all.values.size(); ++i) jacobians[j][i] = all.jacobian[i][j];
    }
    return true;
  }

 private:
  const Misfit& misfit_;
};

Minimum minimum_at(const Misfit& misfit, const Point& point) {
  const std::vector<double> values = misfit.residuals(point, false).values;
  return {point, misfit.chi2(point),
          std::inner_product(values.begin(), values.end(), values.begin(), 0.)};
}

}  // namespace

Minimum minimum_from(const Misfit& misfit, Point start, std::optional<std::size_t> held) {
  for (double& x : start) x = std::clamp(x, 0., 1.);
  if (misfit.dimensions() == 1 && held) return minimum_at(misfit, start);
  ceres::Problem problem;
  std::vector<double*> blocks;
  for (double& x : start) blocks.push_back(&x);
  problem.AddResidualBlock(new AllResiduals(misfit), nullptr, blocks);
  for (std::size_t j = 0; j < start.size(); ++j) {
    if (j == held) {
      problem.SetParameterBlockConstant(blocks[j]);
    } else {
      problem.SetParameterLowerBound(blocks[j], 0, 0);
      problem.SetParameterUpperBound(blocks[j], 0, 1);
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-5;
  SearchCallback callback;
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  stop_if_interrupted();
  return minimum_at(misfit, start);
}

Minimum least_minimum(const Misfit& misfit, const std::vector<Point>& extra) {
  std::vector<std::pair<double, std::size_t>> order;
  std::vector<Point> spread;
  for (std::size_t i = 0; i < kSearched; ++i) {
    spread.push_back(sequence_point(i, misfit.dimensions()));
    order.emplace_back(misfit.chi2(spread.back()), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Point> starts = extra;
  for (std::size_t i = 0; i < kStarts; ++i) starts.push_back(spread[order[i].second]);
  Minimum least = minimum_from(misfit, starts.front());
  for (std::size_t i = 1; i < starts.size(); ++i) {
    const Minimum other = minimum_from(misfit, starts[i]);
    if (other.objective < least.objective) least = other;
  }
  return least;
}

namespace {

constexpr double kGrowth = 1.6;       // factor between outward steps
constexpr double kSmallest = .004;    // first step, fraction of the box
constexpr double kLargest = .15;      // step, fraction of the box
constexpr int kRefinements = 4;       // of the crossing with the limit
constexpr double kCloseEnough = .02;  // to the limit, relative

/// Follows the minimum along one coordinate.
class Tracer {
 public:
  /// @param rise  of chi2 at the end of the interval
  Tracer(const Misfit& misfit, std::size_t held, double rise, const std::vector<Point>& plausible)
      : misfit_(misfit), held_(held), rise_(rise), plausible_(plausible) {}

  /// The minimum with the coordinate held at `x`, searched from its neighbour's and from the
  /// plausible point nearest to it.
  Minimum at(double x, const Minimum& neighbour) const {
    Point near = *std::min_element(plausible_.begin(), plausible_.end(),
                                   [&](const Point& a, const Point& b) {
                                     return std::abs(a[held_] - x) < std::abs(b[held_] - x);
                                   });
    near[held_] = x;
    Point start = neighbour.point;
    start[held_] = x;
    const Minimum one = minimum_from(misfit_, start, held_);
    const Minimum other = minimum_from(misfit_, near, held_);
    return other.objective < one.objective ? other : one;
  }

  /// Where the limit lies between a minimum inside and one outside. All those tried are added to
  /// `minima`.
  double crossing(Minimum inside, Minimum outside, double limit,
                  std::vector<Minimum>& minima) const {
    const auto rise = [&](const Minimum& m) {
      return std::sqrt(std::max(0., m.chi2 - (limit - rise_)));
    };
    double x = 0;
    for (int i = 0; i <= kRefinements; ++i) {
      // Near a minimum the square root of the rise is linear.
      const double a = rise(inside);
      const double b = rise(outside);
      const double fraction = std::clamp((std::sqrt(rise_) - a) / (b - a), .05, .95);
      x = inside.point[held_] + fraction * (outside.point[held_] - inside.point[held_]);
      if (i == kRefinements) break;
      const Minimum middle = at(x, inside);
      minima.push_back(middle);
      if (std::abs(middle.chi2 - limit) < kCloseEnough * rise_) break;
      (middle.chi2 <= limit ? inside : outside) = middle;
    }
    return x;
  }

  /// The end of the interval on one side: `direction` -1 or 1.
  double end(const Minimum& best, double direction, double step,
             std::vector<Minimum>& minima) const {
    const double limit = best.chi2 + rise_;
    Minimum last = best;
    while (true) {
      const double from = last.point[held_];
      const double x = std::clamp(from + direction * step, 0., 1.);
      if (x == from) return x;
      const Minimum next = at(x, last);
      minima.push_back(next);
      if (next.chi2 > limit) return crossing(last, next, limit, minima);
      last = next;
      step = std::min(step * kGrowth, kLargest);
    }
  }

 private:
  const Misfit& misfit_;
  std::size_t held_;
  double rise_;
  const std::vector<Point>& plausible_;
};

}  // namespace

Profile profile_along(const Misfit& misfit, const Minimum& best, std::size_t held,
                      const std::vector<Point>& plausible) {
  Profile profile;
  profile.rise = misfit.interval_limit(best.point, held);
  const Tracer tracer(misfit, held, profile.rise, plausible);
  const double step = std::clamp(.7 * sd_of(plausible)[held], kSmallest, kLargest);
  profile.minima.push_back(best);
  profile.low = tracer.end(best, -1, step, profile.minima);
  profile.high = tracer.end(best, 1, step, profile.minima);
  for (const Point& point : plausible) {
    const double x = point[held];
    if ((x < profile.low || x > profile.high) && misfit.chi2(point) <= best.chi2 + profile.rise) {
      profile.low = std::min(profile.low, x);
      profile.high = std::max(profile.high, x);
    }
  }
  std::sort(profile.minima.begin(), profile.minima.end(),
            [&](const Minimum& a, const Minimum& b) { return a.point[held] < b.point[held]; });
  return profile;
}

namespace {

constexpr double kBetter = .01;  // in chi2: worth restarting
constexpr int kMaxTurns = 4;

std::vector<Profile> profiles_of(const Misfit& misfit, const Minimum& best,
                                 const PosteriorSamples& sets) {
  std::vector<Profile> profiles;
  for (std::size_t j = 0; j < misfit.dimensions(); ++j) {
    profiles.push_back(profile_along(misfit, best, j, sets.points));
  }
  return profiles;
}

/// The lowest minimum on any profile.
Minimum least_of(const std::vector<Profile>& profiles, Minimum least) {
  for (const Profile& profile : profiles) {
    for (const Minimum& minimum : profile.minima) {
      if (minimum.objective < least.objective) least = minimum;
    }
  }
  return least;
}

}  // namespace

Solution solve(const Problem& problem, const std::vector<Run>& runs) {
  Misfit misfit(problem, runs, {}, true);
  Minimum best = least_minimum(misfit, {});
  misfit.inflate_near(best.point);
  best = least_minimum(misfit, {best.point});
  misfit.scale_model_errors(model_error_scale(misfit, best));
  if (misfit.model_scale() > 1) best = least_minimum(misfit, {best.point});
  PosteriorSamples sets = posterior_samples(misfit, problem.settings.seed);
  std::vector<Profile> profiles = profiles_of(misfit, best, sets);
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const Minimum least = least_of(profiles, best);
    if (least.objective > best.objective - kBetter) break;
    best = minimum_from(misfit, least.point);
    profiles = profiles_of(misfit, best, sets);
  }
  Misfit stated = misfit;
  stated.scale_model_errors(1);
  const Minimum least = misfit.model_scale() > 1 ? minimum_from(stated, best.point) : best;
  Freedom freedom = stated.freedom(least.point);
  return {.misfit = std::move(misfit),
          .best = std::move(best),
          .sets = std::move(sets),
          .profiles = std::move(profiles),
          .stated_chi2 = least.chi2,
          .stated_freedom = std::move(freedom)};
}

namespace {

constexpr std::size_t kMax = 8;
constexpr double kDistinct = .2;  // distance in the unit box

double distance2(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

/// Minima within the limit and inside the interval of every coordinate, which may be narrower.
std::vector<Minimum> within_limit(const Solution& solution) {
  std::vector<Minimum> all;
  const auto is_inside = [&](const Point& point) {
    for (std::size_t j = 0; j < point.size(); ++j) {
      const Profile& profile = solution.profiles[j];
      if (point[j] < profile.low || point[j] > profile.high) return false;
    }
    return true;
  };
  const auto add = [&](const Minimum& minimum) {
    if (minimum.chi2 > solution.best.chi2 + kChi2Limit || !is_inside(minimum.point)) return;
    all.push_back(minimum);
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
  while (family.size() < kMax) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (farthest == distance.end() || *farthest < kDistinct * kDistinct) break;
    family.push_back(candidates[static_cast<std::size_t>(farthest - distance.begin())]);
    keep_away_from(family.back().point);
  }
  return family;
}

}  // namespace repose::calibrate
