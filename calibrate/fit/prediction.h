#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Runs spread over the bounds, one each, which show what readings these allow.
inline constexpr std::size_t kRangeRuns = 8;

/// Runs of a stochastic experiment at each of the drawn sets.
inline constexpr int kPredictionRepeats = 2;

/// A measured mean that the fit did not use, as predicted by the fitted coefficients. In its unit;
/// NaN if too few sets gave a reading.
struct Prediction {
  std::string name;
  std::string unit;
  double measured = 0;
  double measured_uncertainty = 0;  ///< standard uncertainty of the mean
  double predicted = 0;
  double uncertainty = 0;      ///< standard: from coefficients, random variation and model error
  Interval interval;           ///< 95 %, of the reading that a bench would give
  double coefficients_sd = 0;  ///< part of the uncertainty from the coefficients
  double run_sd = 0;           ///< scatter of runs at the same coefficients
  double model_sd = 0;         ///< model error, part of the uncertainty
  double difference_sigma = 0;
  double chance = 0;     ///< probability of so large a difference by chance
  double tolerance = 0;  ///< difference that does not matter
  std::optional<MarginSource> tolerance_from = {};  ///< earlier versions did not record it
  /// Readings that the bounds of the coefficients allow, as far as runs spread over them show.
  std::optional<Interval> possible = {};  ///< earlier versions did not compute it
  /// Bench readings that would decide; std::nullopt: it is decided, or no number would.
  std::optional<int> readings_to_decide = {};
  int sets = 0;  ///< number with a reading
  int failed_runs = 0;
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Simulations of all experiments that are held out, at each of the fit's drawn sets and spread
/// over the bounds, with seeds that nothing else uses, as stiff as the study. Empty if nothing is
/// held out.
std::vector<Job> prediction_jobs(const Problem& problem, const JointFit& fit);

/// The experiments whose readings are held out, and the number of runs that predict those of one.
std::vector<Experiment> held_out_experiments(const Problem& problem);
int prediction_runs(const Experiment& experiment);

/// Sets interval and verdict of a prediction whose `predicted`, `model_sd`, `measured_uncertainty`
/// and `tolerance` are known. `of_sets`: the reading that the plausible sets of coefficients give.
void judge(const Problem& problem, const Observable& observable, const UncertainMean& of_sets,
           Prediction& prediction);

/// The predictions of these runs for each of Problem::held_out, compared with the measurements.
/// Formulae and reasons: THEORY.md, "Predictions". Proved by Prediction.* in tests/calibrate.
std::vector<Prediction> predictions_of(const Problem& problem, const JointFit& fit,
                                       const std::vector<Run>& runs);

}  // namespace repose::calibrate
