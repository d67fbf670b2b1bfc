#pragma once

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
  int check_rounds = kMaxCheckRounds;  ///< at most; the last is a large one
  int round_repeats = 2;               ///< fresh seeds at the best fit while checks still move it
  int verification_repeats = 3;        ///< in the last check, which the verdicts are made of
  int family_sets = 2;                 ///< sets of the equivalence family that are checked
  bool is_full = false;  ///< every run is of the study's own grains, and none is coarse
  /// All of it is to end within so many minutes, as foreseen before it began (minutes_budget.h).
  std::optional<double> minutes = {};
};

/// "quick", "standard" or "paper". Throws base::InputError for another name.
Budget budget_named(const std::string& name);

/// The same with no more checks than the budget has time for, where full runs of an experiment cost
/// so much that it has coarse ones: the last check is of four repeats at least, those before it of
/// two at least; with fewer than twelve there is one before it at most, and equally good sets are
/// not checked. Others as they are, and those of minutes, which have theirs.
Budget with_affordable_checks(Budget budget, const Problem& problem);

/// "20min", the name of a budget of so many minutes, and back: none for another name.
std::string name_of_minutes(double minutes);
std::optional<double> minutes_in(const std::string& budget);

}  // namespace repose::calibrate
