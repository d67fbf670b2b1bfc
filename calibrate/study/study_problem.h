#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/study_budget.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// A coefficient with bounds, as a parameter of the fit.
Parameter sought_parameter(const std::string& name, const dem::Coefficient& coefficient);

/// The bench's angle is given as a number, without the definition by which it was measured.
/// Pictures, films and sheets use ours.
bool is_definition_assumed(const dem::ExperimentEntry& entry,
                           const dem::StudyExperiment& described);

/// Whether a study has experiments for which larger grains make cheaper runs.
bool has_coarse_runs(const dem::Study& study, const dem::ClumpShape& grain);

/// What a study leaves to be found, what it measured, and which of that can be used.
struct StudyProblem {
  Problem problem;
  std::vector<std::string> notes;  ///< assumptions, and what was left out
};

/// Unknowns are the coefficients with bounds; observables are what each experiment measured. If the
/// scatter of its readings was not measured, the usual scatter of the experiment is assumed, or the
/// random scatter of the simulation if that is larger (Misfit::measured_uncertainty), which is
/// reported in JointFit::warnings. Pictures must have been measured before: `measured.values` then
/// holds their angles.
/// @throws base::InputError  nothing is to be found, nothing was measured, or the problem is not
/// sound: every error.
StudyProblem problem_of(const dem::Study& study, const dem::ClumpFile& grain, const Budget& budget);

}  // namespace repose::calibrate
