#pragma once

#include <vector>

#include <Eigen/Core>

#include "calibrate/fit/gaussian_process.h"

// Internal to the Gaussian process: included by its .cpp files only.
namespace repose::calibrate {

Eigen::MatrixXd as_rows(const std::vector<Point>& points);

/// How values at two points of the unit box vary together, in variances of the data.
///
/// k(x, x') = signal^2 M(r) + trend^2 s.s' + level^2, with s = (x - 1/2) / length, r = |s - s'|,
/// M(r) = (1 + sqrt5 r + 5/3 r^2) exp(-sqrt5 r): Matern 5/2, Rasmussen and Williams (2006) eq.
/// 4.17, and their linear covariance, sec. 4.2.2 and 2.7. On the runs' diagonal is noise^2 besides.
class Covariance {
 public:
  explicit Covariance(const Hyperparameters& hyper);

  /// Between all runs (rows of x), noise included.
  Eigen::MatrixXd of_runs(const Eigen::MatrixXd& x) const;
  /// (x - 1/2) / length, row by row.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& x) const;
  /// Between one place and all runs, whose rows are scaled() already; `slopes` (a row per run) with
  /// the place's coordinates.
  void with_runs(const Eigen::MatrixXd& scaled_runs,
                 const Eigen::Ref<const Eigen::RowVectorXd>& here, Eigen::VectorXd& k,
                 Eigen::MatrixXd* slopes) const;
  double own(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  Eigen::RowVectorXd own_gradient(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;

  /// Sums of weight(i, j) dk(i, j) / d(log of a hyperparameter): lengths, signal, trend, noise.
  Eigen::VectorXd weighted_gradient(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weight) const;

 private:
  Eigen::RowVectorXd length_;
  double signal2_;
  double trend2_;
  double noise2_;
};

}  // namespace repose::calibrate
