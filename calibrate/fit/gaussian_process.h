#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "calibrate/fit/hyperparameters.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// What a process expects at a point, without the noise of a single run.
struct Expectation {
  double mean = 0;
  double variance = 0;
  Point mean_gradient;  ///< empty unless requested
  Point variance_gradient;
};

/// What values that are means of several runs at one place say about the noise: such a mean has the
/// noise variance divided by its count, and the sum of squares of the runs about it is the noise
/// variance times a chi-square.
struct MeansOfRuns {
  std::vector<double> counts;  ///< of each value; empty: all are single runs
  double squares = 0;          ///< of runs about the means of their places, where known
  double df = 0;               ///< their degrees of freedom
  /// Variance that each value has in addition to the noise, e.g. of a reading that is itself
  /// uncertain; empty: none has.
  std::vector<double> own_variances = {};
};

/// A function of several coordinates, learned from noisy values. Immutable, cheap to copy.
///
/// Formulae: THEORY.md, "Surrogate". Rasmussen and Williams (2006), Gaussian Processes for Machine
/// Learning: prediction eqs. 2.25, 2.26; marginal likelihood 2.30; its gradient 5.9; Matern
/// covariance 4.17; leave-one-out 5.12. Proved by GaussianProcess.* in tests/calibrate.
///
/// Values may be coarse: the function plus a second, independent process of the same length scales,
/// with their own noise. Kennedy and O'Hagan (2000), Biometrika 87, 1, their eq. 1 with rho = 1 and
/// the levels exchanged. Predictions are of the function itself. THEORY.md, "Coarse runs"; proved
/// by CoarseValues.* in tests/calibrate.
class GaussianProcess {
 public:
  /// Fits the hyperparameters to `y` at `x` (at least two, not all alike). `is_stochastic`: values
  /// at one point differ. `start`: an additional start of the search. `kinds`: of each value;
  /// empty: all are full.
  GaussianProcess(const std::vector<Point>& x, const std::vector<double>& y, bool is_stochastic,
                  const std::optional<Hyperparameters>& start, int starts,
                  const MeansOfRuns& means = {}, const std::vector<RunKind>& kinds = {});

  Expectation at(const Point& x, bool with_gradients) const;
  /// How much coarse values are expected to be off at a point, and the variance of that.
  Expectation coarse_shift(const Point& x) const;
  /// Covariances of the expected values at some points, row by row; of coarse values where `kinds`,
  /// one for each, says so.
  std::vector<double> covariance(const std::vector<Point>& points,
                                 const std::vector<RunKind>& kinds = {}) const;
  double noise_sd(RunKind kind = RunKind::full) const;  ///< of single runs
  double log_posterior() const;
  const Hyperparameters& hyperparameters() const;
  std::vector<LeaveOneOut> leave_one_out() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace repose::calibrate
