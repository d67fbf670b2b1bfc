#pragma once

#include <vector>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

struct Cost {
  double seconds = 0;
  int jobs = 0;
};

/// Of one experiment's runs in the smallest first round.
Cost minimum_cost(const Experiment& experiment);

/// Of the smallest first round.
Cost minimum_cost(const Problem& problem);

/// Budget of the smallest fit, s: its first round is the smallest; later ones have over half as
/// much.
double least_budget_s(const Problem& problem);

/// Fraction of the budget for the first round.
inline constexpr double kFirstFraction = .35;

/// Jobs of the first round, for each of measured_experiments(): coarse ones if it has any. Their
/// cost is that of usual_run_s().
///
/// About kFirstFraction of the budget; the seconds are shared in proportion to dimensions times the
/// square root of a run's cost (Neyman's allocation, Cochran 1977, Sampling Techniques, sec. 5.5:
/// counts go as scatter over root of cost). From 2d + 2 to 12d jobs for d parameters.
std::vector<int> first_round_jobs(const Problem& problem);

/// Jobs of a later round, for each of measured_experiments(), in the same proportion. `need`: how
/// much each is wanted (0: not at all).
std::vector<int> round_jobs(const Problem& problem, const std::vector<double>& need,
                            const Cost& left, int rounds_left);

}  // namespace repose::calibrate
