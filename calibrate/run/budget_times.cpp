#include "calibrate/run/budget_times.h"

#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "calibrate/fit/points.h"
#include "calibrate/study/study_simulator.h"

namespace repose::calibrate {
namespace {

constexpr double kHour_s = 3600;
constexpr double kLongest_s = 20;  // of a timed run

struct BudgetPlan {
  Budget budget;
  Problem problem;
  std::vector<ExperimentEstimate> estimates;
};

BudgetPlan plan_of(const PreparedStudy& study, Budget budget) {
  BudgetPlan made{.budget = std::move(budget), .problem = {}, .estimates = {}};
  made.problem = problem_of(study.record.study, study.record.grain, made.budget).problem;
  made.estimates = estimate_of(made.problem, made.budget);
  return made;
}

BudgetTime time_of(BudgetPlan plan, const Pace& pace, int cores) {
  BudgetTime time{.budget = std::move(plan.budget), .experiments = {}, .phases = {}, .seconds = 0};
  for (const ExperimentEstimate& estimate : plan.estimates) {
    for (const auto& [phase, work] : estimate.phases) {
      const double seconds = pace.at(estimate.experiment) * work.seconds / cores;
      time.phases[phase].runs += work.runs;
      time.phases[phase].seconds += seconds;
      time.seconds += seconds;
    }
  }
  time.experiments = std::move(plan.estimates);
  return time;
}

/// Runs that one more hour on all these cores buys.
std::vector<int> hour_runs(const BudgetPlan& plan, const Pace& pace, int cores) {
  Problem problem = plan.problem;
  for (Experiment& experiment : problem.experiments) {
    const auto found = pace.find(experiment.name);
    if (found != pace.end()) experiment.run_s *= found->second;
  }
  std::vector<int> runs = runs_for(problem, kHour_s * cores);
  runs.resize(plan.estimates.size(), 0);  // nothing more for what is held out
  return runs;
}

}  // namespace

Pace timed_pace(const PreparedStudy& study, double longest_s,
                const std::atomic<bool>& is_interrupted,
                const std::function<void(std::size_t, std::size_t)>& timed) {
  const Problem& problem = study.problem.problem;
  const std::vector<ExperimentEstimate> runs = estimate_of(problem, study.record.budget);
  const StudySimulator simulator(study.record.study, study.record.grain, problem.parameters);
  Job job{.experiment = {}, .values = {}, .seed = problem.settings.seed};
  for (const Parameter& parameter : problem.parameters) {
    job.values.push_back((parameter.min + parameter.max) / 2);
  }
  const auto pace_of = [&](const Experiment& experiment, const AssumedInputs& inputs) {
    const double run_s = run_s_of(experiment, inputs);
    job.inputs = inputs;
    return timed_run_s(simulator.spec(job), job.seed, run_s, longest_s, is_interrupted) / run_s;
  };
  Pace pace;
  if (timed) timed(0, runs.size());
  for (const ExperimentEstimate& run : runs) {
    job.experiment = run.experiment;
    const Experiment& experiment = experiment_named(problem, run.experiment);
    double slowest = pace_of(experiment, experiment.full);
    // The first seconds of a full run have few grains yet, while a coarse run reaches its end.
    if (experiment.coarse) slowest = std::max(slowest, pace_of(experiment, *experiment.coarse));
    pace[run.experiment] = slowest;
    if (timed) timed(pace.size(), runs.size());
  }
  return pace;
}

BudgetTimes budget_times(const PreparedStudy& study, const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t, std::size_t)>& timed) {
  const std::vector<ExperimentEstimate> own =
      estimate_of(study.problem.problem, study.record.budget);
  const Pace pace = timed_pace(study, kLongest_s, is_interrupted, timed);
  BudgetTimes times{.cores = study.threads, .budgets = {}, .run_s = {}, .hour_runs = {}};
  for (const ExperimentEstimate& estimate : own) {
    times.run_s.push_back(pace.at(estimate.experiment) * estimate.run_s);
  }
  std::vector<Budget> budgets = {budget_named("quick"), budget_named("standard")};
  if (std::ranges::find(budgets, study.record.budget.name, &Budget::name) == budgets.end()) {
    budgets.insert(budgets.begin(), study.record.budget);
  }
  for (Budget& budget : budgets) {
    budget.is_full = study.record.budget.is_full;
    BudgetPlan plan = plan_of(study, std::move(budget));
    times.hour_runs = hour_runs(plan, pace, times.cores);  // of the last, "standard"
    times.budgets.push_back(time_of(std::move(plan), pace, times.cores));
  }
  return times;
}

std::string to_json(const BudgetTimes& times) {
  using Json = nlohmann::ordered_json;
  Json json{{"cores", times.cores},
            {"runs", Json::array()},
            {"budgets", Json::array()},
            {"hour", Json::array()}};
  for (const BudgetTime& time : times.budgets) {
    Json experiments = Json::array();
    for (const ExperimentEstimate& one : time.experiments) {
      experiments.push_back({{"experiment", one.experiment},
                             {"fit_runs", one.fit_runs()},
                             {"check_runs", one.all().runs - one.fit_runs()}});
    }
    Json phases = Json::array();
    for (const auto& [phase, work] : time.phases) {
      phases.push_back({{"phase", name_of(phase)}, {"runs", work.runs}, {"seconds", work.seconds}});
    }
    json["budgets"].push_back({{"budget", time.budget.name},
                               {"description", time.budget.description},
                               {"seconds", time.seconds},
                               {"experiments", experiments},
                               {"phases", phases}});
  }
  for (std::size_t k = 0; k < times.run_s.size(); ++k) {
    json["runs"].push_back({{"experiment", times.budgets.front().experiments[k].experiment},
                            {"seconds", times.run_s[k]}});
  }
  for (std::size_t k = 0; k < times.hour_runs.size(); ++k) {
    json["hour"].push_back({{"experiment", times.budgets.front().experiments[k].experiment},
                            {"runs", times.hour_runs[k]}});
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent) + '\n';
}

}  // namespace repose::calibrate
