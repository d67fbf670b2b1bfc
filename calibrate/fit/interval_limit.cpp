#include <algorithm>
#include <cmath>

#include "base/distributions.h"
#include "calibrate/fit/linear_fit.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

// Formulae and reasons: THEORY.md, "Few readings". Proved by IntervalLimit.* in tests/calibrate.
double Misfit::interval_limit(const Point& best, std::size_t coordinate) const {
  if (std::ranges::none_of(targets_, [](const Target& target) { return target.widening2 > 1; })) {
    return kChi2Limit;
  }
  std::vector<bool> is_free = free_coordinates(best);
  is_free[coordinate] = true;
  const Linearised fit = linearised(best, is_free);
  const NormalEquations equations = normal_equations(best, is_free, fit);
  const Eigen::Index j = place_of(coordinate);
  // All others lie somewhere within their bounds: a uniform distribution has a variance of 1/12 of
  // the square of its width (GUM 4.3.7).
  Eigen::MatrixXd known =
      equations.held + 12 * Eigen::MatrixXd::Identity(equations.held.rows(), equations.held.cols());
  known(j, j) = equations.held(j, j);
  const Eigen::LLT<Eigen::MatrixXd> inverse(equations.jacobian.transpose() * equations.jacobian +
                                            known);
  const Eigen::MatrixXd moved = inverse.solve(equations.jacobian.transpose());
  // How the coordinate follows each reading, and what remains of a reading after the fit.
  const Eigen::VectorXd follows = (moved * equations.whitening).row(j);
  const Eigen::MatrixXd left =
      equations.whitening.transpose() *
      (equations.whitening - equations.jacobian * moved * equations.whitening);
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(known.rows(), j);
  const Eigen::VectorXd column = inverse.solve(unit);
  const double widened = column(j);
  const double variance = follows.dot(fit.not_widened * follows) + column.dot(known * column);
  double spread = 0;  // of the variance estimate: half its variance
  double by_weights = 0;
  double fewest = base::kManyDf;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = targets_[i];
    if (!std::isfinite(target.scatter_df)) continue;
    const double part = std::pow(follows(place_of(i)), 2) * target.scatter2;
    const double own = left(place_of(i), place_of(i)) * target.widening2 * target.scatter2;
    spread += part * part / target.scatter_df;
    by_weights += 4 * part * std::clamp(own, 0., 1.) / target.scatter_df;
    fewest = std::min(fewest, target.scatter_df);
  }
  if (!(spread > 0)) return kChi2Limit;
  const double df = std::clamp(variance * variance / spread, fewest, base::kManyDf);
  const double t = base::student_t_quantile(.975, df);
  return t * t * (variance + by_weights) / widened;
}

}  // namespace repose::calibrate
