#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/fit/problem.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// How much a study may cost.
struct Budget {
  std::string name;
  std::string description;  ///< "14 minutes of one core for the fit"
  FitSettings settings;
  int round_repeats = 2;         ///< fresh seeds at the best fit while checks still move it
  int verification_repeats = 3;  ///< in the last check, which the verdicts are made of
  int family_sets = 2;           ///< sets of the equivalence family that are checked
  bool is_full = false;          ///< every run is of the study's own grains, and none is coarse
  /// All of it is to end within so many minutes, as foreseen before it began (minutes_budget.h).
  std::optional<double> minutes = {};
};

/// "quick", "standard" or "paper". Throws base::InputError for another name.
Budget budget_named(const std::string& name);

/// The same with no more checks than the budget has time for, where full runs of an experiment cost
/// so much that it has coarse ones: the last check is of four repeats at least, those before it of
/// two, and of equally good sets none. Others as they are, and those of minutes, which have theirs.
Budget with_affordable_checks(Budget budget, const Problem& problem);

/// "20min", the name of a budget of so many minutes, and back: none for another name.
std::string name_of_minutes(double minutes);
std::optional<double> minutes_in(const std::string& budget);

/// A coefficient with bounds, as the fit seeks it.
Parameter sought_parameter(const std::string& name, const dem::Coefficient& coefficient);

/// The bench's angle is given as a number, and not by which definition it was measured. Pictures,
/// films and sheets are measured by ours.
bool is_definition_assumed(const dem::ExperimentEntry& entry,
                           const dem::StudyExperiment& described);

/// Whether a study has experiments of which larger grains make cheaper runs.
bool has_coarse_runs(const dem::Study& study, const dem::ClumpShape& grain);

/// What a study leaves to be found, what it measured, and what of that can be used.
struct StudyProblem {
  Problem problem;
  std::vector<std::string> notes;  ///< assumptions, and what was left out
};

/// Readings that no bench with this grain and protocol gives, a line for each experiment that has
/// one: a bulk density of 1.403 kg/m3, a rebound above the drop. Files of readings must have been
/// read before. Proved by BenchSheets.ImpossibleReadings* in
/// tests/calibrate.
std::vector<base::Fault> impossible_readings(const dem::Study& study, const dem::ClumpShape& grain);

/// Unknowns are the coefficients with bounds; observables what each experiment measured. Where
/// nobody measured how its readings scatter, the usual scatter of the experiment is assumed, or
/// what chance does in the simulation where that is more (Misfit::measured_uncertainty), which is
/// said in JointFit::warnings. Pictures
/// must have been measured before: `measured.values` then holds their angles.
/// @throws base::InputError  nothing is to be found, nothing was measured, or the problem is
/// not sound: every error.
StudyProblem problem_of(const dem::Study& study, const dem::ClumpFile& grain, const Budget& budget);

}  // namespace repose::calibrate
