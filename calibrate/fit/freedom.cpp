#include "calibrate/fit/freedom.h"

#include <algorithm>

#include "calibrate/fit/linear_fit.h"
#include "calibrate/fit/misfit.h"

namespace repose::calibrate {
namespace {

using Table = std::vector<std::vector<double>>;

Table table_of(const Eigen::MatrixXd& matrix) {
  Table table(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      table[static_cast<std::size_t>(i)].push_back(matrix(i, j));
    }
  }
  return table;
}

}  // namespace

Freedom Misfit::freedom(const Point& best) const {
  const std::vector<bool> is_free = free_coordinates(best);
  const Linearised fit = linearised(best, is_free);
  const NormalEquations equations = normal_equations(best, is_free, fit);
  const std::size_t first_prior = surrogates_.size() + risks_.size();
  const Eigen::MatrixXd priors = squares_of(residuals(best, true).jacobian, first_prior,
                                            first_prior + parameters_.size(), is_free);
  const Eigen::MatrixXd followed = fit.slopes * equations.moved * equations.whitening;
  const Eigen::MatrixXd by_slopes = equations.inverse.solve(fit.slopes.transpose());
  const Eigen::MatrixXd unsure = followed * fit.unsure * followed.transpose() +
                                 by_slopes.transpose() * equations.held * by_slopes;
  const auto known = std::ranges::count_if(
      parameters_, [](const Parameter& parameter) { return parameter.prior.has_value(); });
  const double degrees =
      static_cast<double>(fit.slopes.rows()) - (equations.jacobian * equations.moved).trace();
  const double by_priors = static_cast<double>(known) - equations.inverse.solve(priors).trace();
  return {
      .degrees = std::max(degrees, 0.),
      .of_chi2 = std::max(degrees + by_priors, 0.),
      .followed = table_of(fit.unit.asDiagonal() * followed * fit.unit.cwiseInverse().asDiagonal()),
      .unsure = table_of(fit.unit.asDiagonal() * unsure * fit.unit.asDiagonal())};
}

}  // namespace repose::calibrate
