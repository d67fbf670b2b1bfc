#include "calibrate/fit/minimum.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <ceres/ceres.h>

#include "calibrate/fit/search_callback.h"
#include "calibrate/fit/sequence.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kSearched = 256;
constexpr std::size_t kStarts = 12;

/// All residuals; every coordinate is a block of its own, so that any can be held.
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

}  // namespace repose::calibrate
