#include "calibrate/fit/profile.h"

#include <algorithm>
#include <cmath>

#include "calibrate/fit/plausible.h"

namespace repose::calibrate {
namespace {

constexpr double kGrowth = 1.6;       // of the steps outwards
constexpr double kSmallest = .004;    // first step, of the box
constexpr double kLargest = .15;      // step, of the box
constexpr int kRefinements = 4;       // of where the limit is crossed
constexpr double kCloseEnough = .02;  // to the limit, of it

/// Follows the minimum along one coordinate.
class Tracer {
 public:
  Tracer(const Misfit& misfit, std::size_t held, const std::vector<Point>& plausible)
      : misfit_(misfit), held_(held), plausible_(plausible) {}

  /// The minimum where the coordinate is `x`, searched from its neighbour's and from the plausible
  /// point nearest to it.
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

  /// Where the limit lies between a minimum inside and one outside. All tried are added to
  /// `minima`.
  double crossing(Minimum inside, Minimum outside, double limit,
                  std::vector<Minimum>& minima) const {
    const auto rise = [&](const Minimum& m) {
      return std::sqrt(std::max(0., m.chi2 - base(limit)));
    };
    double x = 0;
    for (int i = 0; i <= kRefinements; ++i) {
      // Near a minimum the root of the rise is straight.
      const double a = rise(inside);
      const double b = rise(outside);
      const double fraction = std::clamp((std::sqrt(kChi2Limit) - a) / (b - a), .05, .95);
      x = inside.point[held_] + fraction * (outside.point[held_] - inside.point[held_]);
      if (i == kRefinements) break;
      const Minimum middle = at(x, inside);
      minima.push_back(middle);
      if (std::abs(middle.chi2 - limit) < kCloseEnough * kChi2Limit) break;
      (middle.chi2 <= limit ? inside : outside) = middle;
    }
    return x;
  }

  /// The end of the interval on one side: `direction` -1 or 1.
  double end(const Minimum& best, double direction, double step,
             std::vector<Minimum>& minima) const {
    const double limit = best.chi2 + kChi2Limit;
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
  static double base(double limit) { return limit - kChi2Limit; }

  const Misfit& misfit_;
  std::size_t held_;
  const std::vector<Point>& plausible_;
};

}  // namespace

Profile profile_along(const Misfit& misfit, const Minimum& best, std::size_t held,
                      const std::vector<Point>& plausible) {
  const Tracer tracer(misfit, held, plausible);
  const double step = std::clamp(.7 * sd_of(plausible)[held], kSmallest, kLargest);
  Profile profile;
  profile.minima.push_back(best);
  profile.low = tracer.end(best, -1, step, profile.minima);
  profile.high = tracer.end(best, 1, step, profile.minima);
  for (const Point& point : plausible) {
    const double x = point[held];
    if ((x < profile.low || x > profile.high) && misfit.chi2(point) <= best.chi2 + kChi2Limit) {
      profile.low = std::min(profile.low, x);
      profile.high = std::max(profile.high, x);
    }
  }
  std::sort(profile.minima.begin(), profile.minima.end(),
            [&](const Minimum& a, const Minimum& b) { return a.point[held] < b.point[held]; });
  return profile;
}

}  // namespace repose::calibrate
