#include "vision/measure/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace repose::vision {
namespace {

constexpr int kResamples = 300;

}  // namespace

double independent_blocks(std::size_t points, std::size_t block) {
  return std::max(
      4.0, static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(1, block)));
}

double block_bootstrap_slope_error(std::span<const double> x, std::span<const double> residual,
                                   std::size_t block, std::uint64_t seed) {
  const std::size_t n = x.size();
  if (n < 4) return 0;
  block = std::clamp<std::size_t>(block, 1, n / 2);
  double middle = 0;
  for (const double value : x) middle += value / static_cast<double>(n);
  double sxx = 0;
  for (const double value : x) sxx += (value - middle) * (value - middle);
  if (sxx <= 0) return 0;

  std::mt19937_64 random(seed);  // the engine is the same everywhere; distributions are not
  const std::uint64_t starts = n - block + 1;
  double sum = 0;
  double squares = 0;
  for (int resample = 0; resample < kResamples; ++resample) {
    double shift = 0;
    for (std::size_t i = 0; i < n;) {
      const std::size_t from = random() % starts;
      for (std::size_t k = 0; k < block && i < n; ++k, ++i) {
        shift += (x[i] - middle) * residual[from + k];
      }
    }
    const double slope = shift / sxx;
    sum += slope;
    squares += slope * slope;
  }
  const double variance =
      std::max(0.0, squares / kResamples - (sum / kResamples) * (sum / kResamples));
  const double blocks = independent_blocks(n, block);
  return std::sqrt(variance * blocks / (blocks - 2));
}

}  // namespace repose::vision
