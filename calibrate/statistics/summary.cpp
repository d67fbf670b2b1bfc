#include "calibrate/statistics/summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/distributions.h"
#include "base/input_error.h"

namespace repose::calibrate {

Summary summarise(std::span<const double> values) {
  if (values.empty()) {
    throw base::InputError(
        {.where = "repeats", .value = "0 values have no mean", .fix = "give at least one."});
  }
  const auto n = static_cast<double>(values.size());
  Summary repeats{.n = static_cast<int>(values.size()),
                  .mean = std::accumulate(values.begin(), values.end(), 0.0) / n,
                  .sd = {},
                  .mean_uncertainty = {}};
  if (repeats.n == 1) return repeats;

  double squares = 0;
  for (const double value : values) squares += (value - repeats.mean) * (value - repeats.mean);
  repeats.sd = std::sqrt(squares / (n - 1));
  const double t = base::student_t_quantile(.975, n - 1);
  repeats.mean_uncertainty = t * *repeats.sd / std::sqrt(n);
  return repeats;
}

std::vector<std::size_t> outliers_of(std::span<const double> values, double alpha) {
  constexpr std::size_t kFewest = 5, kMaxOutliers = 20;
  if (values.size() < kFewest) return {};
  std::vector<std::size_t> left(values.size()), taken;
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::size_t outliers = 0;
  for (std::size_t i = 1; i <= std::min(kMaxOutliers, values.size() / 3); ++i) {
    const double count = static_cast<double>(left.size()), df = count - 2;
    double mean = 0, squares = 0;
    for (const std::size_t k : left) mean += values[k] / count;
    for (const std::size_t k : left) squares += (values[k] - mean) * (values[k] - mean);
    const auto distance = [&](std::size_t k) { return std::abs(values[k] - mean); };
    const auto farthest = std::ranges::max_element(left, {}, distance);
    const double t = base::student_t_quantile(1 - alpha / (2 * count), df);
    const double limit = (count - 1) * t / std::sqrt((df + t * t) * count);
    if (distance(*farthest) > limit * std::sqrt(squares / (count - 1))) outliers = i;
    taken.push_back(*farthest);
    left.erase(farthest);
  }
  taken.resize(outliers);
  std::ranges::sort(taken);
  return taken;
}

}  // namespace repose::calibrate
