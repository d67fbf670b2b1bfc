#include "vision/measure/line_fit.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <ceres/ceres.h>

namespace repose::vision {

namespace {

constexpr double kTukeyTuning = 4.685;   // 95 % efficiency on normal residuals
constexpr double kSmallestScale = 1e-6;  // keeps a perfect line solvable
constexpr int kMaxRounds = 8;            // of fitting line and scale alternately
constexpr double kSettled = 0.02;        // relative change of scale that leaves the line alone

/// Vertical distances of all points from one line; the loss is applied to each by IRLS weights
/// inside Ceres, so every point is its own residual block.
struct VerticalDistance {
  double x;
  double y;

  template <typename T>
  bool operator()(const T* line, T* residual) const {
    residual[0] = T(y) - (line[0] + line[1] * T(x));
    return true;
  }
};

}  // namespace

namespace {

double weight_at(std::span<const double> weight, std::size_t i) {
  return weight.empty() ? 1 : weight[i];
}

/// The smallest value up to which the weights sum to half of the total.
double weighted_median(std::span<const double> values, std::span<const double> weight) {
  std::vector<std::pair<double, double>> sorted;
  double left = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sorted.emplace_back(values[i], weight[i]);
    left += weight[i] / 2;
  }
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [value, counts] : sorted) {
    left -= counts;
    if (left <= 0) return value;
  }
  return sorted.back().first;
}

}  // namespace

double median(std::span<const double> values, std::span<const double> weight) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (std::any_of(weight.begin(), weight.end(), [](double one) { return one != 1; })) {
    return weighted_median(values, weight);
  }
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (sorted.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(sorted.begin(), middle)) / 2;
}

LineFit least_squares_line(std::span<const double> x, std::span<const double> y,
                           std::span<const double> weight) {
  const std::size_t n = std::min(x.size(), y.size());
  double all = 0;
  for (std::size_t i = 0; i < n; ++i) all += weight_at(weight, i);
  if (!(all > 0)) return {};
  double mean_x = 0;
  double mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += weight_at(weight, i) * x[i] / all;
    mean_y += weight_at(weight, i) * y[i] / all;
  }
  double sxx = 0;
  double sxy = 0;
  double syy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double counts = weight_at(weight, i);
    sxx += counts * (x[i] - mean_x) * (x[i] - mean_x);
    sxy += counts * (x[i] - mean_x) * (y[i] - mean_y);
    syy += counts * (y[i] - mean_y) * (y[i] - mean_y);
  }
  // All points at the same x: what remains of sxx is rounding.
  if (sxx <= 1e-20 * all * mean_x * mean_x || sxx == 0) {
    return {.intercept = mean_y};
  }
  const double slope = sxy / sxx;
  return {.intercept = mean_y - slope * mean_x,
          .slope = slope,
          .r2 = syy > 0 ? sxy * sxy / (sxx * syy) : 1};
}

namespace {

/// 1.4826 times the median distance from the line: the standard deviation if residuals are normal.
double scale_around(const LineFit& line, std::span<const double> x, std::span<const double> y,
                    std::span<const double> weight) {
  std::vector<double> distance;
  for (std::size_t i = 0; i < x.size(); ++i) distance.push_back(std::abs(y[i] - line.y(x[i])));
  return std::max(kMadToSigma * median(distance, weight), kSmallestScale);
}

}  // namespace

LineFit robust_line(std::span<const double> x, std::span<const double> y,
                    std::span<const double> weight, double smallest_scale) {
  const LineFit start = least_squares_line(x, y, weight);
  if (x.size() < 4) return start;
  const auto scale_of = [&](const LineFit& line) {
    return std::max(scale_around(line, x, y, weight), smallest_scale);
  };
  double scale = scale_of(start);

  // Centred and scaled, so that both parameters have the same size.
  const double middle = (x.front() + x.back()) / 2;
  const double reach = std::max(std::abs(x.back() - x.front()) / 2, 1e-9);
  double line[2] = {start.y(middle), start.slope * reach};
  ceres::LossFunctionWrapper tukey(new ceres::TukeyLoss(kTukeyTuning * scale),
                                   ceres::TAKE_OWNERSHIP);
  std::deque<ceres::ScaledLoss> lessened;  // of points with partial weight; addresses stay valid
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double counts = weight_at(weight, i);
    ceres::LossFunction* loss = &tukey;
    if (counts != 1) {
      loss = &lessened.emplace_back(&tukey, counts, ceres::DO_NOT_TAKE_OWNERSHIP);
    }
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<VerticalDistance, 1, 2>(
                                 new VerticalDistance{(x[i] - middle) / reach, y[i]}),
                             loss, line);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 50;
  LineFit fit = start;
  for (int round = 0; round < kMaxRounds; ++round) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return start;
    fit.slope = line[1] / reach;
    fit.intercept = line[0] - fit.slope * middle;
    const double next = scale_of(fit);
    if (std::abs(next - scale) <= kSettled * scale) break;
    scale = next;
    tukey.Reset(new ceres::TukeyLoss(kTukeyTuning * scale), ceres::TAKE_OWNERSHIP);
  }
  return fit;
}

namespace {

constexpr int kResamples = 300;

}  // namespace

double independent_blocks(double points, std::size_t block) {
  return std::max(4.0, points / static_cast<double>(std::max<std::size_t>(1, block)));
}

double block_bootstrap_slope_error(std::span<const double> x, std::span<const double> residual,
                                   std::size_t block, std::uint64_t seed,
                                   std::span<const double> weight) {
  const std::size_t n = x.size();
  if (n < 4) return 0;
  block = std::clamp<std::size_t>(block, 1, n / 2);
  double all = 0;
  for (std::size_t i = 0; i < n; ++i) all += weight_at(weight, i);
  double middle = 0;
  for (std::size_t i = 0; i < n; ++i) middle += weight_at(weight, i) * x[i] / all;
  std::vector<double> lever;  // of each point on the slope
  double sxx = 0;
  for (std::size_t i = 0; i < n; ++i) {
    lever.push_back(weight_at(weight, i) * (x[i] - middle));
    sxx += lever[i] * (x[i] - middle);
  }
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
        shift += lever[i] * residual[from + k];
      }
    }
    const double slope = shift / sxx;
    sum += slope;
    squares += slope * slope;
  }
  const double variance =
      std::max(0.0, squares / kResamples - (sum / kResamples) * (sum / kResamples));
  const double blocks = independent_blocks(all, block);
  return std::sqrt(variance * blocks / (blocks - 2));
}

}  // namespace repose::vision
