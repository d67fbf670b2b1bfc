#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/plan/foresight.h"
#include "calibrate/plan/offers.h"
#include "calibrate/study/job_runner.h"

/// Which experiments to do: the work of `repose plan`.

namespace repose::calibrate {

/// A parameter counts as determined if it is in this fraction of the materials. In the others it
/// lies too close to a bound for an interval that ends inside it.
inline constexpr double kEnough = .8;

/// An experiment to be done, and what is known after it and those before it.
struct PlannedStep {
  std::size_t experiment = 0;  ///< index in Foresight::prospects()
  DesignForecast outlook;
};

/// Of all sets of experiments yet to be done, the smallest that determines nearly as much as all of
/// them together: at least 97 % of the sum over parameters of the determined fraction of materials,
/// each counted up to kEnough. Of equally small ones, the one with the narrowest intervals. Ordered
/// so that each step gains most. Empty: none gains anything.
std::vector<PlannedStep> smallest_set(const Foresight& foresight);

/// What all experiments would reveal about a study's coefficients.
struct Plan {
  std::vector<std::string> parameters;  ///< names, in the order of all lists by parameter
  std::vector<ForecastTerm> prospects;
  std::map<std::string, double> run_s;  ///< duration of a run of each experiment on one core, s
  int readings = 0;                     ///< of a future experiment
  DesignForecast now;                   ///< from the present measurements
  std::vector<PlannedStep> steps;       ///< the smallest set of further experiments
  std::vector<std::string> notes;       ///< experiments that are left out, and why
  int simulated = 0;                    ///< runs made by this call
  int reused = 0;                       ///< runs found in the folder
};

/// The budget of a plan's runs: this many core seconds.
Budget plan_budget(double core_s);

/// What a plan simulates: the first round of a fit to all experiments. For each experiment, those
/// of a larger budget begin with those of a smaller one.
std::vector<Job> plan_jobs(const OfferedStudy& offered);

/// Number of runs of each experiment, and their duration, in a sentence.
/// @param asked_s  core time by the program's own measure: mentioned if the minimum is more
std::string foreseen(const OfferedStudy& offered, double asked_s);

/// Simulates each experiment over the whole box, and evaluates what it reveals. Runs are saved: a
/// calibration in the same folder starts with them. std::nullopt if interrupted.
/// @throws base::InputError  the study has a protocol that cannot be run; a measured experiment has
/// too few readings; the folder cannot be written.
std::optional<Plan> make_plan(const OfferedStudy& offered, const StudyContext& context,
                              int readings);

/// All of it.
std::string plan_json(const Plan& plan, const OfferedStudy& offered);

}  // namespace repose::calibrate
