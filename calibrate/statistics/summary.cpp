#include "calibrate/statistics/summary.h"

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

}  // namespace repose::calibrate
