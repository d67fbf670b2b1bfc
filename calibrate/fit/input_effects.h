#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Change of a quantity when an input is increased by its standard uncertainty.
struct InputChange {
  std::string name;        ///< of a reading or a coefficient
  double change = 0;       ///< NaN where it is not known
  double uncertainty = 0;  ///< standard, from chance in the simulations; likewise
};

/// Effects of one input that the study holds fixed (Problem::fixed_inputs).
struct InputEffect {
  std::string input;
  std::string unit;
  double value = 0;
  double sd = 0;  ///< standard uncertainty
  bool is_assumed = false;
  std::vector<InputChange> readings;      ///< of the experiments that were simulated with it
  std::vector<InputChange> coefficients;  ///< in Problem's order; empty if no reading is known
  std::vector<std::string> not_varied;    ///< experiments it can affect that were not simulated
};

/// All inputs together, compared with the interval of a coefficient.
struct CombinedEffect {
  std::string name;
  double value = 0;       ///< as fitted
  double effect = 0;      ///< 1.96 times the square root of the sum of squares of all changes
  double half_width = 0;  ///< of the coefficient's own 95 % interval
  Interval interval;      ///< that interval, widened by the effect, within the bounds
};

struct InputPlan {
  std::vector<Job> jobs;
  std::vector<InputEffect> inputs;  ///< includes those not varied; changes still to be filled in
  double run_s = 0;
};

/// Each input in turn changed by its standard uncertainty, where `checks` (jobs of the last check)
/// were simulated: with their seeds, one run if deterministic, otherwise as many of them as a fifth
/// of FitSettings::budget_s allows for all inputs. If that does not even allow five each, the
/// cheapest are done first, and the rest are listed.
InputPlan plan_inputs(const Problem& problem, const std::vector<Job>& checks);

/// Compares the plan's runs with those of the check with the same seeds, and finds how far the fit
/// moves as a result. `runs`: those of the fit. Formulae and reasons: THEORY.md, "Inputs held
/// fixed". Proved by InputEffects.* in tests/calibrate.
std::vector<InputEffect> effects_of_inputs(const Problem& problem, const InputPlan& plan,
                                           const std::vector<Run>& checks,
                                           const std::vector<Run>& varied, const JointFit& fit,
                                           const std::vector<Run>& runs);

/// Empty if no input moves a known coefficient.
std::vector<CombinedEffect> combined_effects(const Problem& problem, const JointFit& fit,
                                             const std::vector<InputEffect>& effects);

}  // namespace repose::calibrate
