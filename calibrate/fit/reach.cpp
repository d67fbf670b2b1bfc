#include "calibrate/fit/reach.h"

#include <algorithm>
#include <cmath>

#include "calibrate/fit/sequence.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kSpread = 512;
constexpr double kMatters = .05;  // of the reading's span: less is no limit

}  // namespace

Extreme extreme_of(const Surrogate& surrogate, std::size_t dimensions, bool largest) {
  const double sign = largest ? 1 : -1;
  const auto height = [&](const Point& point) { return sign * surrogate.simulated(point); };
  Point best = sequence_point(0, dimensions);
  double most = height(best);
  double least = most;
  for (std::size_t i = 1; i < kSpread; ++i) {
    const Point point = sequence_point(i, dimensions);
    const double here = height(point);
    least = std::min(least, here);
    if (here > most) {
      most = here;
      best = point;
    }
  }
  for (double step = .5; step > .005; step /= 2) {
    for (std::size_t move = 0; move < 2 * dimensions; ++move) {
      Point point = best;
      double& x = point[move / 2];
      x = std::clamp(x + (move % 2 == 0 ? step : -step), 0., 1.);
      const double here = height(point);
      if (here > most) {
        most = here;
        best = point;
      }
    }
  }
  Extreme extreme{sign * most, surrogate.uncertainty(best), {}};
  for (std::size_t j = 0; j < dimensions; ++j) {
    if (best[j] > 0 && best[j] < 1) continue;
    Point inside = best;
    inside[j] = .5;
    if (most - height(inside) > kMatters * (most - least)) {
      extreme.limits.push_back({j, best[j] >= 1});
    }
  }
  return extreme;
}

}  // namespace repose::calibrate
