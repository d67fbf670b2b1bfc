#include "calibrate/fit/linear_fit.h"

#include <algorithm>
#include <cmath>

namespace repose::calibrate {
namespace {

constexpr double kAtBound = 1e-6;  // of the box
constexpr double kSettled = .25;   // of the uncertainty of measurement: see THEORY.md, "Freedom"

}  // namespace

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

std::vector<bool> free_coordinates(const Point& best) {
  std::vector<bool> is_free;
  for (const double x : best) is_free.push_back(x > kAtBound && x < 1 - kAtBound);
  return is_free;
}

Misfit::Linearised Misfit::linearised(const Point& best, const std::vector<bool>& is_free) const {
  const Eigen::Index readings = place_of(surrogates_.size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(readings, readings);
  Linearised all{.slopes = Eigen::MatrixXd::Zero(readings, place_of(best.size())),
                 .covariance = none,
                 .not_widened = none,
                 .unsure = none,
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
      const Target& target = targets_[together.observables[a]];
      const double more2 = (target.widening2 - 1) * target.scatter2;
      parts[a].measured_sd = std::sqrt(std::max(0., target.sd * target.sd - more2));
    }
    add_to(all.not_widened);
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

Misfit::NormalEquations Misfit::normal_equations(const Point& best,
                                                 const std::vector<bool>& is_free,
                                                 const Linearised& fit) const {
  const Eigen::Index readings = fit.slopes.rows();
  const Residuals all = residuals(best, true);
  Eigen::VectorXd counts = Eigen::VectorXd::Ones(readings);
  for (Eigen::Index i = 0; robust_ && i < readings; ++i) {
    counts(i) = robust_slope(all.values[static_cast<std::size_t>(i)]);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(fit.covariance);
  NormalEquations equations;
  equations.whitening =
      counts.asDiagonal() *
      Eigen::MatrixXd(root.matrixL().solve(Eigen::MatrixXd::Identity(readings, readings)));
  equations.jacobian = equations.whitening * fit.slopes;
  equations.held = squares_of(all.jacobian, surrogates_.size(), all.jacobian.size(), is_free);
  Eigen::MatrixXd normal = equations.jacobian.transpose() * equations.jacobian + equations.held;
  for (std::size_t j = 0; j < best.size(); ++j) {
    if (!is_free[j]) normal(place_of(j), place_of(j)) = 1;
  }
  equations.inverse.compute(normal);
  equations.moved = equations.inverse.solve(equations.jacobian.transpose());
  return equations;
}

}  // namespace repose::calibrate
