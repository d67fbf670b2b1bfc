#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// What stiffer grains change in a measured reading, at the same coefficients. In its unit; NaN
/// where too few runs gave a reading.
struct StiffnessCheck {
  std::string name;
  std::string unit;
  double stiffness = 1;         ///< of the stiffer grains, as a multiple of the study's
  double stiffness_factor = 1;  ///< the same as a part of the real one
  double change = 0;            ///< of the mean: stiffer less the study's
  double uncertainty = 0;       ///< standard uncertainty of the change
  Interval interval;            ///< 95 %
  double chance = 0;            ///< of so large a change by chance
  double limit = 0;             ///< half-width of the measured mean's 95 % interval
  int runs = 0;                 ///< of stiffer grains, with a reading
  int failed_runs = 0;
  /// agrees: the change is shown to be within the limit. disagrees: it is more than chance makes.
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Simulations of every measured experiment whose grains are softer than real ones, at one set of
/// coefficients: ten times stiffer than the study, or as stiff as real grains if that is less.
/// Those held out also as stiff as the study, which no other check simulates there.
struct StiffnessPlan {
  std::vector<Job> jobs;
  std::vector<std::string> too_dear;  ///< experiments that would take too much of the budget
  double run_s = 0;                   ///< work of all jobs, by Experiment::run_s
};

/// `repeats` of each, or no fewer than five where time is short; the cheapest first, as long as a
/// fifth of FitSettings::budget_s lasts.
StiffnessPlan plan_stiffness(const Problem& problem, const std::vector<double>& values,
                             int repeats);

/// What the runs of the plan say, against those among them, or in the fit's checks, that are as
/// stiff as the study. Formulae and reasons: THEORY.md, "Stiffer grains". Proved by
/// StiffnessCheck.* in tests/calibrate.
std::vector<StiffnessCheck> check_stiffness(const Problem& problem,
                                            const std::vector<double>& values,
                                            const std::vector<Run>& runs, const JointFit& fit);

}  // namespace repose::calibrate
