#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Runs all over the bounds, one each, which tell what readings these allow.
inline constexpr std::size_t kRangeRuns = 8;

/// Runs of a stochastic experiment at each of the drawn sets.
inline constexpr int kPredictionRepeats = 2;

/// A measured mean that the fit knows nothing of, as the fitted coefficients predict it. In its
/// unit; NaN where too few sets gave a reading.
struct Prediction {
  std::string name;
  std::string unit;
  double measured = 0;
  double measured_uncertainty = 0;  ///< standard uncertainty of the mean
  double predicted = 0;
  double uncertainty = 0;  ///< standard: by the coefficients, by chance in the runs, by the model
  Interval interval;       ///< 95 %, of the reading that a bench would have
  double coefficients_sd = 0;  ///< of the uncertainty, what the coefficients leave open
  double run_sd = 0;           ///< scatter of runs at the same coefficients
  double model_sd = 0;         ///< what the model gets wrong, part of the uncertainty
  double difference_sigma = 0;
  double chance = 0;     ///< that prediction and measurement differ so much by chance
  double tolerance = 0;  ///< what does not matter
  std::optional<MarginSource> tolerance_from = {};  ///< earlier versions did not say
  /// Of readings that the bounds of the coefficients allow, as far as runs all over them tell.
  std::optional<Interval> possible = {};  ///< earlier versions did not ask
  /// Of the bench, that would decide; none: it is decided, or no number does.
  std::optional<int> readings_to_decide = {};
  int sets = 0;  ///< with a reading
  int failed_runs = 0;
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Simulations of all experiments that are held out, at each of the fit's drawn sets and all over
/// the bounds, with seeds that nothing else uses, as stiff as the study. None where nothing is held
/// out.
std::vector<Job> prediction_jobs(const Problem& problem, const JointFit& fit);

/// The experiments that readings are held out of, and how many runs predict those of one.
std::vector<Experiment> held_out_experiments(const Problem& problem);
int prediction_runs(const Experiment& experiment);

/// Interval and verdict of a prediction whose `predicted`, `model_sd`, `measured_uncertainty` and
/// `tolerance` are known. `of_sets`: the reading that the plausible sets of coefficients lead to.
void judge(const Problem& problem, const Observable& observable, const UncertainMean& of_sets,
           Prediction& prediction);

/// What these runs predict for each of Problem::held_out, and whether it is what was measured.
/// Formulae and reasons: THEORY.md, "Predictions". Proved by Prediction.* in tests/calibrate.
std::vector<Prediction> predictions_of(const Problem& problem, const JointFit& fit,
                                       const std::vector<Run>& runs);

}  // namespace repose::calibrate
