#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/plan/foresight.h"
#include "calibrate/plan/offered_study.h"
#include "calibrate/plan/smallest_set.h"
#include "calibrate/study/job_runner.h"

/// Which experiments to do: what `repose plan` tells.
namespace repose::calibrate {

/// What all experiments would tell of a study's coefficients.
struct Plan {
  std::vector<std::string> parameters;  ///< names, in the order of all lists by parameter
  std::vector<Prospect> prospects;
  std::map<std::string, double> run_s;  ///< a run of each experiment took so long on a core, s
  int readings = 0;                     ///< of an experiment to be done
  Outlook now;                          ///< by what is measured
  std::vector<PlannedStep> steps;       ///< the smallest set of experiments to be done
  std::vector<std::string> notes;       ///< experiments that are left out, and why
  int simulated = 0;                    ///< runs made by this call
  int reused = 0;                       ///< runs found in the folder
};

/// The budget of a plan's runs: this many seconds of one core.
Budget plan_budget(double core_s);

/// What a plan simulates: the first round of a fit to all experiments. By experiment, those of a
/// larger budget begin with those of a smaller one.
std::vector<Job> plan_jobs(const OfferedStudy& offered);

/// Simulates each experiment over the whole box, and says what it tells. Runs are kept: a
/// calibration in the same folder begins with them. None when it was interrupted.
/// @throws base::InputError  the study has a protocol that cannot be run; a measured
/// experiment has too few readings; the folder cannot be written.
std::optional<Plan> make_plan(const OfferedStudy& offered, const StudyContext& context,
                              int readings);

/// All of it.
std::string plan_json(const Plan& plan, const OfferedStudy& offered);

}  // namespace repose::calibrate
