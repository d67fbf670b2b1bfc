#pragma once

#include <Eigen/Core>

#include "calibrate/fit/hyperparameters.h"

// Internal to the Gaussian process: included by .cpp files only.

namespace repose::calibrate {

/// How values at two points of the unit box vary together, in variances of the data.
///
/// k(x, x') = signal^2 M(r) + trend^2 s.s' + level^2, with s = (x - 1/2) / length, r = |s - s'|,
/// M(r) = (1 + sqrt5 r + 5/3 r^2) exp(-sqrt5 r): Matern 5/2, Rasmussen and Williams (2006) eq.
/// 4.17, and their linear covariance, sec. 4.2.2 and 2.7. On the runs' diagonal is noise^2 besides,
/// by the number of runs that a value is the mean of, and a value's own variance, which is known.
/// Two coarse values have shift^2 + drift^2 M(r) besides.
class Covariance {
 public:
  /// @param counts  of runs that each value is the mean of; empty: of one
  /// @param own_variances  variance of each value beside the noise; empty: none has any
  /// @param coarse  1 for each value that is coarse, else 0; empty: none is
  explicit Covariance(const Hyperparameters& hyper, const Eigen::ArrayXd& counts = {},
                      const Eigen::ArrayXd& own_variances = {}, const Eigen::ArrayXd& coarse = {});

  /// Between all runs (rows of x), noise included.
  Eigen::MatrixXd of_runs(const Eigen::MatrixXd& x) const;
  /// (x - 1/2) / length, row by row.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& x) const;
  /// Between one place and all runs, whose rows are scaled() already; `slopes` (a row per run) with
  /// the place's coordinates.
  void with_runs(const Eigen::MatrixXd& scaled_runs,
                 const Eigen::Ref<const Eigen::RowVectorXd>& here, Eigen::VectorXd& k,
                 Eigen::MatrixXd* slopes) const;
  /// What coarse runs have beside that with a coarse value at the place; 0 for the others.
  Eigen::VectorXd shifts_with_runs(const Eigen::MatrixXd& scaled_runs,
                                   const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  /// Of the shift of a coarse value alone.
  double own_shift() const { return shift2_ + drift2_; }
  /// The same as this for other places than the runs'.
  Covariance of_places(const Eigen::ArrayXd& coarse) const;
  double own(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  Eigen::RowVectorXd own_gradient(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;

  /// Sums of weight(i, j) dk(i, j) / d(log of a hyperparameter), in the order of from_logs().
  Eigen::VectorXd weighted_gradient(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weight) const;

 private:
  bool is_coarse(Eigen::Index run) const { return coarse_.size() > 0 && coarse_(run) > 0; }
  /// Variance of a run's own error by chance.
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
