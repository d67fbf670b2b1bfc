#pragma once

#include <Eigen/Core>

#include "calibrate/fit/hyperparameters.h"

// Internal to the Gaussian process: included by .cpp files only.

namespace repose::calibrate {

/// Covariance of values at two points of the unit box, in variances of the data.
///
/// k(x, x') = signal^2 M(r) + trend^2 s.s' + level^2, with s = (x - 1/2) / length, r = |s - s'|,
/// M(r) = (1 + sqrt5 r + 5/3 r^2) exp(-sqrt5 r): Matern 5/2, Rasmussen and Williams (2006) eq.
/// 4.17, and their linear covariance, sec. 4.2.2 and 2.7. The diagonal for runs also has noise^2,
/// divided by the number of runs averaged, and a value's own known variance. Two coarse values also
/// share shift^2 + drift^2 M(r).
class Covariance {
 public:
  /// @param counts  number of runs averaged in each value; empty: one each
  /// @param own_variances  variance of each value in addition to the noise; empty: none has any
  /// @param coarse  1 for each value that is coarse, else 0; empty: none is
  explicit Covariance(const Hyperparameters& hyper, const Eigen::ArrayXd& counts = {},
                      const Eigen::ArrayXd& own_variances = {}, const Eigen::ArrayXd& coarse = {});

  /// Between all runs (rows of x), noise included.
  Eigen::MatrixXd of_runs(const Eigen::MatrixXd& x) const;
  /// (x - 1/2) / length, row by row.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& x) const;
  /// Between one place and all runs, whose rows are already scaled(). `slopes` (a row per run):
  /// derivatives with respect to the place's coordinates.
  void with_runs(const Eigen::MatrixXd& scaled_runs,
                 const Eigen::Ref<const Eigen::RowVectorXd>& here, Eigen::VectorXd& k,
                 Eigen::MatrixXd* slopes) const;
  /// Additional covariance of coarse runs with a coarse value at the place; 0 for the others.
  Eigen::VectorXd shifts_with_runs(const Eigen::MatrixXd& scaled_runs,
                                   const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  /// Variance of a coarse value's shift alone.
  double own_shift() const { return shift2_ + drift2_; }
  /// The same covariance for places other than the runs'.
  Covariance of_places(const Eigen::ArrayXd& coarse) const;
  double own(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  Eigen::RowVectorXd own_gradient(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;

  /// Sums of weight(i, j) dk(i, j) / d(log of a hyperparameter), in the order of from_logs().
  Eigen::VectorXd weighted_gradient(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weight) const;

 private:
  bool is_coarse(Eigen::Index run) const { return coarse_.size() > 0 && coarse_(run) > 0; }
  /// Variance of a run's random error.
  double noise2(Eigen::Index run) const {
    return (is_coarse(run) ? coarse_noise2_ : noise2_) / (counts_.size() > 0 ? counts_(run) : 1);
  }

  Eigen::RowVectorXd length_;
  double signal2_;
  double trend2_;
  double noise2_;
  double shift2_ = 0;
  double drift2_ = 0;
  double coarse_noise2_ = 0;
  Eigen::ArrayXd counts_;
  Eigen::ArrayXd own_variances_;
  Eigen::ArrayXd coarse_;
};

}  // namespace repose::calibrate
