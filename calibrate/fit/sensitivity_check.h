#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Inputs that a study assumes without fitting them, and that simulations can bring closer to
/// reality: the stiffness of grains, and the number of spheres that represent one.
enum class AssumedInput { stiffness, spheres };

/// Change of a measured reading with another value of an assumed input, at the same coefficients.
/// In its unit; NaN if too few runs gave a reading.
struct SensitivityCheck {
  std::string name;
  std::string unit;
  AssumedInput input = AssumedInput::stiffness;
  double multiple = 1;     ///< of the study's stiffness, or spheres
  double value = 1;        ///< resulting input: a stiffness factor, a number of spheres
  double grain_size = 1;   ///< of the grains compared, as a multiple of the study's: coarse runs
  double change = 0;       ///< of the mean: with that value minus with the study's
  double uncertainty = 0;  ///< standard uncertainty of the change
  Interval interval;       ///< 95 %
  double chance = 0;       ///< probability of so large a change by chance
  double limit = 0;        ///< half-width of the measured mean's 95 % interval
  int runs = 0;            ///< with that value and a reading
  int failed_runs = 0;
  /// agrees: the change is shown to be within the limit. disagrees: it is shown to be beyond it.
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Simulations of every measured experiment in which the input can be closer to reality, at one set
/// of coefficients: grains ten times stiffer than the study's, or as stiff as real ones if that is
/// less; four times the spheres, or as many as possible if that is less. Held-out experiments are
/// also run as in the study, since no other check simulates them there. If an experiment has coarse
/// runs, all of its runs here are coarse: larger grains are assumed to change by as much as the
/// study's; failed coarse runs say nothing about those.
struct SensitivityPlan {
  std::vector<Job> jobs;
  std::vector<std::string> over_budget;  ///< experiments that would take too much of the budget
  double run_s = 0;                      ///< work of all jobs, by Experiment::run_s
};

/// `repeats` of each, 24 of coarse runs if that is more, or no fewer than five if time is short;
/// the cheapest first, as long as a fifth of FitSettings::budget_s lasts.
/// @param made  jobs already made by the plan of another input
SensitivityPlan plan_sensitivity(const Problem& problem, AssumedInput input,
                                 const std::vector<double>& values, int repeats,
                                 const std::vector<Job>& made = {});

/// Compares the plan's runs with those among them, or in the fit's checks, that are as in the
/// study. Formulae and reasons: THEORY.md, "Assumed inputs". Proved by StiffnessCheck.* and
/// ShapeCheck.* in tests/calibrate.
std::vector<SensitivityCheck> check_sensitivity(const Problem& problem, AssumedInput input,
                                                const std::vector<double>& values,
                                                const std::vector<Run>& runs, const JointFit& fit);

/// What a coefficient would have to be with the other value of an assumed input: with the stiffer
/// grains of the checks, or with more spheres.
struct MovedCoefficient {
  std::string name;
  double value = 0;
  Interval interval;  ///< 95 %, profile likelihood
  Verdict verdict = Verdict::undetermined;
};

/// In the order of Problem::parameters; empty if no check knows the change. The same runs fitted to
/// means without these changes, with the uncertainty that the checks give: THEORY.md, "Assumed
/// inputs". Proved by StifferCoefficients.* in tests/calibrate.
std::vector<MovedCoefficient> moved_coefficients(const Problem& problem,
                                                 const std::vector<SensitivityCheck>& checks,
                                                 const std::vector<Run>& runs);

}  // namespace repose::calibrate
