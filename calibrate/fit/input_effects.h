#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// By how much something is changed by an input that is larger by its standard uncertainty.
struct InputChange {
  std::string name;        ///< of a reading or a coefficient
  double change = 0;       ///< NaN where it is not known
  double uncertainty = 0;  ///< standard, by chance in the simulations; likewise
};

/// What one input of a study that was held fixed moves (Problem::fixed_inputs).
struct InputEffect {
  std::string input;
  std::string unit;
  double value = 0;
  double sd = 0;  ///< standard uncertainty
  bool is_assumed = false;
  std::vector<InputChange> readings;      ///< of the experiments that were simulated with it
  std::vector<InputChange> coefficients;  ///< in Problem's order; none where no reading is known
  std::vector<std::string> not_varied;    ///< experiments that it can move, and were not simulated
};

/// All inputs together, beside the interval of a coefficient.
struct CombinedEffect {
  std::string name;
  double value = 0;       ///< as fitted
  double effect = 0;      ///< 1.96 times the root of the sum of squares of all changes
  double half_width = 0;  ///< of the coefficient's own 95 % interval
  Interval interval;      ///< that interval, widened by the effect, within the bounds
};

struct InputPlan {
  std::vector<Job> jobs;
  std::vector<InputEffect> inputs;  ///< with what is not varied; changes are to be filled in
  double run_s = 0;
};

/// One input after the other changed by its standard uncertainty, where `checks` (jobs of the last
/// check) were simulated: with their seeds, one run without chance, else as many of them as a fifth
/// of FitSettings::budget_s allows for all inputs. Where it does not even allow for five each, the
/// cheapest are done first, and what is left is named.
InputPlan plan_inputs(const Problem& problem, const std::vector<Job>& checks);

/// What the plan's runs say, against those of the check with the same seeds, and how far the fit
/// moves for it. `runs`: those of the fit. Formulae and reasons: THEORY.md, "Inputs held fixed".
/// Proved by InputEffects.* in tests/calibrate.
std::vector<InputEffect> effects_of_inputs(const Problem& problem, const InputPlan& plan,
                                           const std::vector<Run>& checks,
                                           const std::vector<Run>& varied, const JointFit& fit,
                                           const std::vector<Run>& runs);

/// None where no input moves a known coefficient.
std::vector<CombinedEffect> combined_effects(const Problem& problem, const JointFit& fit,
                                             const std::vector<InputEffect>& effects);

}  // namespace repose::calibrate
