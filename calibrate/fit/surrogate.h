#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/gaussian_process.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// How a reading is warped before it is learned: w = asinh(y / warp); w = y if warp is 0.
///
/// Burbidge, Magee, Robb (1988), J. Am. Stat. Assoc. 83, 123: a logarithm that also takes values at
/// and below 0. With normal noise of `noise_sd` in w, y has the expectation warp sinh(w)
/// exp(noise_sd^2 / 2). Proved by AsinhWarp.* in tests/calibrate.
struct AsinhWarp {
  double warp = 0;
  double noise_sd = 0;

  double warped(double y) const;
  /// Expected reading for an expected w.
  double expected(double w) const;
  /// Its slope with respect to w.
  double slope(double w) const;
  /// The w with this expected reading.
  double of_expected(double y) const;
  /// Scatter of single readings at w.
  double scatter(double w) const;
};

/// Training data of a surrogate: the runs of one experiment that have the reading.
struct TrainingSet {
  std::vector<std::size_t> parameters;  ///< the experiment's
  bool is_stochastic = true;
  std::vector<Point> places;  ///< in the experiment's own coordinates
  std::vector<double> readings;
  std::vector<std::size_t> runs = {};  ///< their indices among all runs
  int readings_per_run = 1;            ///< the experiment's
  double sd_within = 0;                ///< of its Experiment::scatter_within
  /// Run::repeats of each reading, and the sd of these repeats; NaN: unknown. Empty: no reading is
  /// a mean.
  std::vector<int> repeats = {};
  std::vector<double> repeat_sds = {};
  /// Run::reading_sd of each reading, 0 if it has none; empty: none has.
  std::vector<double> own_sds = {};
  /// Kind of each reading's run; empty: all are full.
  std::vector<RunKind> kinds = {};

  RunKind kind(std::size_t reading) const { return kinds.empty() ? RunKind::full : kinds[reading]; }
};

/// Offset of coarse runs from full ones, in the reading's unit.
struct CoarseShift {
  double value = 0;
  double uncertainty = 0;  ///< standard
};

/// One reading as a function of all parameters, with its uncertainty.
class Surrogate {
 public:
  /// `start` shortens the search: hyperparameters of a similar training set. `thorough`: more
  /// starts.
  Surrogate(const TrainingSet& training_set, const std::optional<Surrogate>& start, bool thorough);

  /// Every run gave the same number: nothing can be learned from it.
  bool constant() const { return !process_; }
  const AsinhWarp& warp() const { return warp_; }
  /// Of w, at a point of all coordinates; variances are inflated and corrected for few runs.
  Expectation at(const Point& point, bool with_gradients) const;
  /// The expected reading, never below 0 unless some run was, and its standard uncertainty.
  double simulated(const Point& point) const;
  double uncertainty(const Point& point) const;
  /// Standard deviation, by chance, of single bench readings where w is expected.
  double reading_sd(double w) const;
  /// Scatter of single runs about the curve, in w: random or, if deterministic, what the curve does
  /// not follow.
  double run_sd(RunKind kind = RunKind::full) const {
    return process_ ? process_->noise_sd(kind) : 0;
  }
  /// Covariance of w between points, inflated, row by row; of coarse runs where `kinds` says so.
  std::vector<double> covariance(const std::vector<Point>& points,
                                 const std::vector<RunKind>& kinds = {}) const;
  /// How much more coarse runs read than full ones at a point, and its standard uncertainty;
  /// std::nullopt if all are full.
  std::optional<CoarseShift> coarse_shift(const Point& point) const;

  /// Enlarges the uncertainty if leave-one-out errors are larger than expected, over all runs or
  /// the fifth of them nearest to `point`, at least ten.
  void inflate_near(const Point& point);

  double inflation() const { return inflation_; }
  /// Student-t inflation of the uncertainty because the runs' noise is known from few: see
  /// THEORY.md. 1 for deterministic experiments.
  double few_runs_factor() const { return few_runs_factor_; }
  /// Leave-one-out errors over their sd's, in the order of the training set; empty if constant.
  std::vector<double> standardised_errors() const;
  const TrainingSet& training_set() const { return training_set_; }
  /// Root mean square of the standardised errors; not inflated.
  double leave_one_out_sigma() const;
  /// Root mean square error in the reading's unit.
  double leave_one_out_error() const;
  std::vector<double> length_scales() const;

 private:
  Point seen(const Point& point) const;
  GaussianProcess learned(double warp, const std::optional<Hyperparameters>& start, int starts,
                          std::size_t every) const;
  /// Number of runs whose sd about this reading is known; 1 if it is not.
  double runs_told(std::size_t reading) const;
  double repeats_of(std::size_t reading) const;
  double factor_of_few_runs() const;
  double best_warp(const std::optional<Hyperparameters>& start) const;

  TrainingSet training_set_;
  AsinhWarp warp_;
  std::optional<GaussianProcess> process_;
  double inflation_ = 1;
  double few_runs_factor_ = 1;
};

/// Runs in a canonical order (experiment, values, seed), each job once: sums over them are
/// identical to the last bit, whatever order they were done in. Throws base::InputError for runs of
/// another problem.
std::vector<Run> in_order(const Problem& problem, const std::vector<Run>& runs);

/// Whether an experiment is stochastic: not if it is known to be deterministic, nor if its runs
/// show it, e.g. of one ball dropped on a plate: at several places, with several readings, repeats
/// with other seeds gave the same result. `runs` in_order. Proved by Chance.* in tests/calibrate.
bool has_chance(const Experiment& experiment, const std::vector<Run>& runs);

/// Scatter of a bench's single readings within runs (Experiment::scatter_within): root mean square
/// over the runs that report it, 0 if none does.
double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs);

/// The runs of `experiment` that have the reading as a number; if deterministic, one per place,
/// since repeats add nothing. `runs` in_order.
TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs);

/// Number of runs of `experiment` that have the reading as a number, including coarse ones.
int readings_among(const Experiment& experiment, const std::string& reading,
                   const std::vector<Run>& runs);

/// Number of full runs in the training set.
std::size_t full_readings(const TrainingSet& training_set);

/// Where an experiment was run, and whether it failed; coarse runs only if they did not fail.
struct Attempts {
  std::vector<std::size_t> parameters;
  std::vector<Point> places;
  std::vector<bool> failed;

  int failures() const;
};

Attempts attempts_of(const Problem& problem, const Experiment& experiment,
                     const std::vector<Run>& runs);

}  // namespace repose::calibrate
