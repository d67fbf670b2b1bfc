#include "calibrate/plan/plan.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/first_round.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/study/job_runner.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

/// One after the other, as the first round of a fit to all experiments.
class PlanRuns {
 public:
  PlanRuns(const OfferedStudy& offered, const StudyContext& context)
      : offered_(offered), context_(context), runner_(offered.problem, context) {}

  /// False when interrupted.
  bool make(Plan& plan) {
    std::map<std::string, std::vector<Job>> jobs;
    for (Job& job : plan_jobs(offered_)) {
      later_s_ += run_s_of(offered_.problem, job);
      jobs[job.experiment].push_back(std::move(job));
    }
    for (const Experiment& experiment : offered_.problem.experiments) {
      if (!make(experiment, jobs[experiment.name], plan)) return false;
    }
    plan.simulated = runner_.simulated();
    plan.reused = runner_.reused();
    return true;
  }

  const std::vector<Run>& runs() const { return runs_; }

 private:
  bool make(const Experiment& experiment, const std::vector<Job>& jobs, Plan& plan) {
    for (const Job& job : jobs) later_s_ -= run_s_of(offered_.problem, job);
    try {
      const auto done = runner_.get(experiment.name, jobs, later_s_);
      if (!done) return false;
      runs_.insert(runs_.end(), done->begin(), done->end());
      plan.run_s[experiment.name] = mean_wall_s(jobs);
    } catch (const base::InputError& error) {
      if (!offered_.added.contains(dem::experiment_named(experiment.name).experiment)) throw;
      plan.notes.push_back(
          fmt::format("{} is left out: as it is usually done it cannot be run with "
                      "these grains. To have it in the plan, describe it in the "
                      "study. {}",
                      experiment.name, error.what()));
    }
    return true;
  }

  double mean_wall_s(const std::vector<Job>& jobs) const {
    double sum_s = 0;
    for (const Job& job : jobs) {
      const auto saved = context_.folder.find(context_.simulator.spec(job), job.seed);
      if (saved) sum_s += saved->wall_s;
    }
    return sum_s / static_cast<double>(jobs.size());
  }

  const OfferedStudy& offered_;
  const StudyContext& context_;
  JobRunner runner_;
  std::vector<Run> runs_;
  double later_s_ = 0;
};

}  // namespace

Budget plan_budget(double core_s) {
  Budget budget = budget_named("quick");
  budget.name = "plan";
  budget.settings.budget_s = core_s / kFirstFraction;
  return budget;
}

std::vector<Job> plan_jobs(const OfferedStudy& offered) {
  Problem everything = offered.problem;
  everything.observables.clear();
  for (const Experiment& experiment : offered.problem.experiments) {
    Observable& observable = everything.observables.emplace_back();
    observable.name = observable.experiment = experiment.name;
  }
  return first_round(everything);
}

std::optional<Plan> make_plan(const OfferedStudy& offered, const StudyContext& context,
                              int readings) {
  Plan plan;
  plan.readings = readings;
  plan.notes = offered.notes;
  for (const Parameter& parameter : offered.problem.parameters) {
    plan.parameters.push_back(parameter.name);
  }
  PlanRuns runs(offered, context);
  if (!runs.make(plan)) return std::nullopt;
  try {
    const FitWatch watch(context.is_interrupted);
    const Foresight foresight(offered.problem, runs.runs(), readings);
    plan.prospects = foresight.prospects();
    plan.now = foresight.with({});
    plan.steps = smallest_set(foresight);
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  return plan;
}

}  // namespace repose::calibrate
