#pragma once

#include <limits>
#include <optional>
#include <string>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

inline constexpr int kMaxCheckRounds = 3;

/// How much a study may cost.
struct Budget {
  std::string name;
  std::string description;  ///< "14 minutes of one core for the fit"
  FitSettings settings;
  int check_rounds = kMaxCheckRounds;  ///< maximum; the last is a large one
  int round_repeats = 2;               ///< fresh seeds at the best fit while checks still move it
  int verification_repeats = 3;        ///< in the last check, which the verdicts are based on
  int family_sets = 2;                 ///< of the equivalence family that are checked
  bool is_full = false;                ///< every run has the study's own grains; none is coarse
  /// The longest run that its checks have time for, s (Experiment::run_s): where the study's own
  /// grains would take longer, larger ones take their place.
  double longest_run_s = std::numeric_limits<double>::infinity();
  /// The whole study should end within this time, as estimated before it began (minutes_budget.h).
  std::optional<double> minutes = {};
};

/// "quick", "standard" or "paper". Throws base::InputError for another name.
Budget budget_named(const std::string& name);

/// A budget of minutes, whose seconds and checks are still to be found (minutes_budget.h): a full
/// run takes at most a twelfth of the time of all cores, and a sixth of the minutes.
/// @param pace  duration of a run here, as a multiple of Experiment::run_s
Budget budget_of(double minutes, int cores, double pace = 1);

/// The same with no more checks than the budget has time for, if full runs of an experiment are so
/// expensive that it has coarse ones, or larger grains: the last check has at least four repeats,
/// those before it at least two; with fewer than twelve there is at most one before it, and equally
/// good sets are not checked. Other budgets are unchanged, as are those of minutes, which plan
/// their own checks.
Budget with_affordable_checks(Budget budget, const Problem& problem);

/// "20min", the name of a budget of that many minutes, and back: std::nullopt for another name.
std::string name_of_minutes(double minutes);
std::optional<double> minutes_in(const std::string& budget);

}  // namespace repose::calibrate
