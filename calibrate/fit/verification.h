#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// An observable as fresh simulations give it.
struct Agreement {
  std::string observable;
  double measured = 0;
  double measured_uncertainty = 0;
  double simulated = 0;              ///< mean of the runs with a reading; NaN without any
  double simulated_uncertainty = 0;  ///< of that mean; 0 for experiments without chance
  double difference_sigma = 0;       ///< (simulated - measured) / both uncertainties; NaN likewise
  int runs = 0;                      ///< with a reading
  int failed_runs = 0;
};

/// One set of parameters, checked.
struct Verification {
  std::vector<double> values;
  std::vector<Agreement> observables;  ///< in Problem's order
  /// No observable is farther off than chance lets all of them be in 95 of 100 cases (Bonferroni),
  /// by Welch's t-test where few runs or few readings are behind them.
  bool agrees = false;
};

/// Jobs at one set of parameters with seeds that propose() never uses: `repeats` of each measured
/// experiment, one of those without chance. `set` tells sets apart: 0 for the best fit, 1, 2, ...
/// for those of the equivalence family.
std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set);

/// Compares the runs of verification_jobs(), among any others, with what was measured. `fit`, where
/// there is one, tells how much single runs scatter better than a handful of repeats does: the
/// larger of both counts; and what the scatter of the measurement was taken to be.
Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit = nullptr);

}  // namespace repose::calibrate
