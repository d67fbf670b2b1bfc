#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Seeds of checks begin here; a study never has so many jobs.
inline constexpr std::uint64_t kFirstCheckSeed = 1'000'000'000;

/// An observable in fresh simulations.
struct Agreement {
  std::string observable;
  double measured = 0;
  double measured_uncertainty = 0;
  double simulated = 0;              ///< mean of the runs with a reading; NaN without any
  double simulated_uncertainty = 0;  ///< of that mean; 0 for experiments without chance
  double difference_sigma = 0;       ///< (simulated - measured) / both uncertainties; NaN likewise
  /// Probability of so large a difference by chance, part of which a fit to the same mean follows;
  /// NaN likewise.
  double chance = 0;
  double tolerance = 0;                             ///< difference that does not matter
  std::optional<MarginSource> tolerance_from = {};  ///< earlier versions did not record it
  Interval difference;  ///< 90 %: equivalence compares this with the tolerance
  /// True difference that four of five such checks detect; NaN if the fit follows it.
  double detectable = 0;
  std::optional<int> runs_to_decide;  ///< std::nullopt: it is decided, or no number of runs would
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
  /// Of the bench; likewise, if only their number were increased.
  std::optional<int> readings_to_decide = {};
  int runs = 0;  ///< number with a reading
  int failed_runs = 0;
};

/// One set of parameters, checked.
struct Verification {
  std::vector<double> values;
  std::vector<Agreement> observables;  ///< in Problem's order
  double chance = 0;  ///< of so large differences overall (joint_chance); NaN without readings
  /// agrees: all observables do. disagrees: `chance` is below 5 %, or an experiment gives no
  /// reading at all.
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Jobs at one set of parameters with seeds that propose() never uses, all as stiff as the study:
/// `repeats` of the most expensive measured experiment, more of cheap ones, one of deterministic
/// ones. `set` distinguishes sets.
std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set);

/// Compares the runs of verification_jobs(), among any others, with the measurements. `fit`, if
/// given, knows the scatter of single runs better than a few repeats do: the larger of both counts;
/// it also gives the scatter assumed for the measurement. `made_by`: the freedom of the fit, made
/// before these runs, whose best set this is; agreement with random errors of the bench that it
/// could follow does not count. Formulae and reasons: THEORY.md, "Verification". Proved by
/// Verification.* and Agreement.* in tests/calibrate.
Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit = nullptr,
                    const Freedom* made_by = nullptr);

/// A surrogate's prediction of fresh runs that it had not seen. In the observable's unit.
struct SurrogateCheck {
  std::string observable;
  double predicted = 0;
  double uncertainty = 0;  ///< standard uncertainty of the prediction
  double simulated = 0;    ///< mean of the runs; NaN without any
  double chance = 0;       ///< probability of so large an error by chance; NaN likewise
  /// The error is larger than chance makes it in 5 % of all checks (Bonferroni over the
  /// observables), and larger than half the measurement uncertainty: less does not matter.
  bool misses = false;
};

/// Tests the surrogates of a fit with fresh runs at its best values that it has not seen.
std::vector<SurrogateCheck> check_surrogates(const Problem& problem, const JointFit& fit,
                                             const std::vector<Run>& runs);

}  // namespace repose::calibrate
