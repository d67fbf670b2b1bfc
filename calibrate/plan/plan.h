#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/plan/foresight.h"
#include "calibrate/plan/offers.h"
#include "calibrate/study/job_runner.h"

/// Which experiments to do: what `repose plan` tells.

namespace repose::calibrate {

/// A parameter counts as one that would be determined when it is in this part of the materials. In
/// the others it lies too near to a bound for an interval that ends inside of it.
inline constexpr double kEnough = .8;

/// An experiment to be done, and what is known once it and those before it are.
struct PlannedStep {
  std::size_t experiment = 0;  ///< place in Foresight::prospects()
  DesignForecast outlook;
};

/// Of all sets of experiments that are yet to be done, the smallest that determines nearly as much
/// as all of them together: at least 97 % of the parts of materials of all parameters, each counted
/// up to kEnough. Of several as small, the one with the narrowest intervals. In the order in which
/// each gives most. Empty: nothing is gained by any.
std::vector<PlannedStep> smallest_set(const Foresight& foresight);

/// What all experiments would tell of a study's coefficients.
struct Plan {
  std::vector<std::string> parameters;  ///< names, in the order of all lists by parameter
  std::vector<ForecastTerm> prospects;
  std::map<std::string, double> run_s;  ///< a run of each experiment took so long on a core, s
  int readings = 0;                     ///< of an experiment to be done
  DesignForecast now;                   ///< by what is measured
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

/// How many runs that is of each experiment, and how long it takes, in a sentence.
/// @param asked_s  of one core, by the program's own measure: said where the least is more
std::string foreseen(const OfferedStudy& offered, double asked_s);

/// Simulates each experiment over the whole box, and says what it tells. Runs are kept: a
/// calibration in the same folder begins with them. None when it was interrupted.
/// @throws base::InputError  the study has a protocol that cannot be run; a measured
/// experiment has too few readings; the folder cannot be written.
std::optional<Plan> make_plan(const OfferedStudy& offered, const StudyContext& context,
                              int readings);

/// All of it.
std::string plan_json(const Plan& plan, const OfferedStudy& offered);

}  // namespace repose::calibrate
