#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/fit/misfit.h"

namespace repose::calibrate {
namespace {

constexpr double kAtBound = 1e-6;  // of the box
constexpr double kSettled = .25;   // of the uncertainty of measurement: see THEORY.md, "Freedom"

using Table = std::vector<std::vector<double>>;

Eigen::Index place_of(std::size_t place) { return static_cast<Eigen::Index>(place); }

Table table_of(const Eigen::MatrixXd& matrix) {
  Table table(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      table[static_cast<std::size_t>(i)].push_back(matrix(i, j));
    }
  }
  return table;
}

/// Of residuals' rows, R^T R; without the coordinates that are not free.
Eigen::MatrixXd squares_of(const std::vector<Point>& rows, std::size_t from, std::size_t to,
                           const std::vector<bool>& is_free) {
  const Eigen::Index size = place_of(is_free.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t row = from; row < to; ++row) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(size);
    for (std::size_t j = 0; j < is_free.size(); ++j) {
      if (is_free[j]) own(place_of(j)) = rows[row][j];
    }
    sum += own * own.transpose();
  }
  return sum;
}

}  // namespace

struct Misfit::Linearised {
  Eigen::MatrixXd slopes;      ///< of the expected readings (rows) with the coordinates
  Eigen::MatrixXd covariance;  ///< of the differences, V
  Eigen::MatrixXd unsure;      ///< of the expected readings alone
  Eigen::VectorXd unit;        ///< one of these, in the reading's own unit
};

Misfit::Linearised Misfit::linearised(const Point& best, const std::vector<bool>& is_free) const {
  const Eigen::Index readings = place_of(surrogates_.size());
  Linearised all{.slopes = Eigen::MatrixXd::Zero(readings, place_of(best.size())),
                 .covariance = Eigen::MatrixXd::Zero(readings, readings),
                 .unsure = Eigen::MatrixXd::Zero(readings, readings),
                 .unit = Eigen::VectorXd(readings)};
  for (const Together& together : together_) {
    std::vector<CorrelatedPart> parts = parts_of(together, best, true);
    const auto add_to = [&](Eigen::MatrixXd& matrix) {
      for (std::size_t a = 0; a < parts.size(); ++a) {
        for (std::size_t b = 0; b < parts.size(); ++b) {
          matrix(place_of(together.observables[a]), place_of(together.observables[b])) =
              covariance_of(parts, together.correlation, a, b);
        }
      }
    };
    add_to(all.covariance);
    for (std::size_t a = 0; a < parts.size(); ++a) {
      const std::size_t i = together.observables[a];
      const double unit = surrogates_[i].warp().slope(targets_[i].value);
      all.unit(place_of(i)) = unit;
      for (std::size_t j = 0; j < best.size(); ++j) {
        if (is_free[j]) all.slopes(place_of(i), place_of(j)) = parts[a].gradient[j];
      }
      const double settled = kSettled * measured_[i] / unit;
      parts[a].variance = std::max(parts[a].variance, settled * settled);
      parts[a].measured_sd = 0;
      parts[a].model2 = 0;
    }
    add_to(all.unsure);
  }
  return all;
}

Freedom Misfit::freedom(const Point& best) const {
  std::vector<bool> is_free;
  for (const double x : best) is_free.push_back(x > kAtBound && x < 1 - kAtBound);
  const Linearised fit = linearised(best, is_free);
  const Eigen::Index readings = fit.slopes.rows();
  const Residuals all = residuals(best, true);
  Eigen::VectorXd counts = Eigen::VectorXd::Ones(readings);
  for (Eigen::Index i = 0; robust_ && i < readings; ++i) {
    counts(i) = robust_slope(all.values[static_cast<std::size_t>(i)]);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(fit.covariance);
  const Eigen::MatrixXd whitening =
      counts.asDiagonal() *
      Eigen::MatrixXd(root.matrixL().solve(Eigen::MatrixXd::Identity(readings, readings)));
  const Eigen::MatrixXd jacobian = whitening * fit.slopes;
  const std::size_t first_prior = surrogates_.size() + risks_.size();
  const Eigen::MatrixXd held =
      squares_of(all.jacobian, surrogates_.size(), all.jacobian.size(), is_free);
  const Eigen::MatrixXd priors =
      squares_of(all.jacobian, first_prior, first_prior + parameters_.size(), is_free);
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian + held;
  for (std::size_t j = 0; j < best.size(); ++j) {
    if (!is_free[j]) normal(place_of(j), place_of(j)) = 1;
  }
  const Eigen::LLT<Eigen::MatrixXd> inverse(normal);  // C is its inverse
  const Eigen::MatrixXd moved = inverse.solve(jacobian.transpose());
  const Eigen::MatrixXd followed = fit.slopes * moved * whitening;
  const Eigen::MatrixXd by_slopes = inverse.solve(fit.slopes.transpose());
  const Eigen::MatrixXd unsure =
      followed * fit.unsure * followed.transpose() + by_slopes.transpose() * held * by_slopes;
  const auto known = std::ranges::count_if(
      parameters_, [](const Parameter& parameter) { return parameter.prior.has_value(); });
  const double degrees = static_cast<double>(readings) - (jacobian * moved).trace();
  const double by_priors = static_cast<double>(known) - inverse.solve(priors).trace();
  return {
      .degrees = std::max(degrees, 0.),
      .of_chi2 = std::max(degrees + by_priors, 0.),
      .followed = table_of(fit.unit.asDiagonal() * followed * fit.unit.cwiseInverse().asDiagonal()),
      .unsure = table_of(fit.unit.asDiagonal() * unsure * fit.unit.asDiagonal())};
}

}  // namespace repose::calibrate
