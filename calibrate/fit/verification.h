#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// An observable as fresh simulations give it.
struct Agreement {
  std::string observable;
  double measured = 0;
  double measured_uncertainty = 0;
  double simulated = 0;               ///< mean of the runs with a reading; NaN without any
  double simulated_uncertainty = 0;   ///< of that mean; 0 for experiments without chance
  double difference_sigma = 0;        ///< (simulated - measured) / both uncertainties; NaN likewise
  double chance = 0;                  ///< that it is as large by chance; NaN likewise
  double tolerance = 0;               ///< what does not matter
  Interval difference;                ///< 90 %: what equivalence compares with the tolerance
  double detectable = 0;              ///< true difference that is seen in four of five such checks
  std::optional<int> runs_to_decide;  ///< none: it is decided, or no number of runs does
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
  int runs = 0;  ///< with a reading
  int failed_runs = 0;
};

/// One set of parameters, checked.
struct Verification {
  std::vector<double> values;
  std::vector<Agreement> observables;  ///< in Problem's order
  double chance = 0;  ///< that all differ so much by chance (joint_chance); NaN without readings
  /// agrees: all observables do. disagrees: `chance` is below 5 %, or an experiment gives no
  /// reading at all.
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Jobs at one set of parameters with seeds that propose() never uses, all as stiff as the study:
/// `repeats` of the measured experiment that costs most, more of cheap ones, one of those without
/// chance. `set` tells sets apart.
std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set);

/// Compares the runs of verification_jobs(), among any others, with what was measured. `fit`, where
/// there is one, tells how much single runs scatter better than a handful of repeats does: the
/// larger of both counts; and what the scatter of the measurement was taken to be. Formulae and
/// reasons: THEORY.md, "Verification". Proved by Verification.* and Agreement.* in tests/calibrate.
Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit = nullptr);

}  // namespace repose::calibrate
