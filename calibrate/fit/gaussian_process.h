#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// Of a Gaussian process: smooth part, straight trend and noise, in sd's of the data.
struct Hyperparameters {
  std::vector<double> length;  ///< per coordinate of the unit box
  double signal = 1;
  double trend = 1;  ///< slope per length scale
  double noise = .1;
};

/// What a process expects at a point, without the noise of a single run.
struct Expectation {
  double mean = 0;
  double variance = 0;
  Point mean_gradient;  ///< empty unless asked for
  Point variance_gradient;
};

/// What values tell of the noise that are means of several runs at their place, each: such a mean
/// has the noise's variance by its count, and the runs' squares about it have the distribution of
/// the noise's variance times a chi-square.
struct MeansOfRuns {
  std::vector<double> counts;  ///< of each value; empty: all are single runs
  double squares = 0;          ///< of runs about the means of their places, where these are told
  double df = 0;               ///< their degrees of freedom
  /// Variance that each value has beside the noise, as of a reading that is uncertain by itself;
  /// empty: none has.
  std::vector<double> own_variances = {};
};

/// Error of a run's prediction by all other runs, and the sd that was expected of it.
struct LeaveOneOut {
  double error = 0;
  double sd = 0;
};

/// A function of several coordinates, learned from noisy values. Immutable, cheap to copy.
///
/// Formulae: THEORY.md, "Surrogate". Rasmussen and Williams (2006), Gaussian Processes for Machine
/// Learning: prediction eqs. 2.25, 2.26; marginal likelihood 2.30; its gradient 5.9; Matern
/// covariance 4.17; leave-one-out 5.12. Proved by GaussianProcess.* in tests/calibrate.
class GaussianProcess {
 public:
  /// Fits the hyperparameters to `y` at `x` (at least two, not all alike). `is_stochastic`: values
  /// at one point differ. `start` is where the search begins besides its own starts.
  GaussianProcess(const std::vector<Point>& x, const std::vector<double>& y, bool is_stochastic,
                  const std::optional<Hyperparameters>& start, int starts,
                  const MeansOfRuns& means = {});

  Expectation at(const Point& x, bool with_gradients) const;
  /// Covariances of what is expected at some points, row by row.
  std::vector<double> covariance(const std::vector<Point>& points) const;
  double noise_sd() const;  ///< of single runs
  double log_posterior() const;
  const Hyperparameters& hyperparameters() const;
  std::vector<LeaveOneOut> leave_one_out() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace repose::calibrate
