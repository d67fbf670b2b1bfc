#include "cli/calibrate/dry_run.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate/fit/points.h"
#include "calibrate/study/study_estimate.h"
#include "calibrate/study/study_simulator.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr double kHour_s = 3600;

/// By the name of the experiment: seconds here for a second of the program's own measure.
using AdaptiveTimestep = std::map<std::string, double>;

struct BudgetPlan {
  calibrate::Budget budget;
  calibrate::Problem problem;
  std::vector<calibrate::ExperimentEstimate> estimates;
};

BudgetPlan plan_of(const CalibratePlan& plan, const std::string& name) {
  BudgetPlan made{.budget = calibrate::budget_named(name), .problem = {}, .estimates = {}};
  made.problem = problem_of(plan.record.study, plan.record.grain, made.budget).problem;
  made.estimates = estimate_of(made.problem, made.budget);
  return made;
}

/// A run of each, coefficients in the middle of their bounds.
AdaptiveTimestep timed_pace(const CalibratePlan& plan,
                            const std::vector<calibrate::ExperimentEstimate>& runs,
                            const std::atomic<bool>& is_interrupted) {
  constexpr double kLongest_s = 20;
  const calibrate::Problem& problem = plan.problem.problem;
  const calibrate::StudySimulator simulator(plan.record.study, plan.record.grain,
                                            problem.parameters);
  calibrate::Job job{.experiment = {}, .values = {}, .seed = problem.settings.seed};
  for (const calibrate::Parameter& parameter : problem.parameters) {
    job.values.push_back((parameter.min + parameter.max) / 2);
  }
  AdaptiveTimestep pace;
  Progress progress(runs.size(), "timed");
  for (const calibrate::ExperimentEstimate& run : runs) {
    job.experiment = run.experiment;
    const double run_s =
        calibrate::timed_run_s(simulator.spec(job), job.seed, kLongest_s, is_interrupted);
    pace[run.experiment] = run_s / run.run_s;
    progress.advance();
  }
  return pace;
}

/// "40 s", "12 min", "3.5 h".
std::string duration(double seconds) {
  constexpr double kMinute_s = 60;
  if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
  return fmt::format("{:.1f} h", seconds / kHour_s);
}

/// What a budget makes of each experiment, and how long that takes at most.
struct BudgetColumn {
  std::vector<std::string> runs;
  std::string time;
};

BudgetColumn budget_column(const BudgetPlan& budget, const AdaptiveTimestep& pace, int jobs) {
  BudgetColumn column;
  double all_s = 0;
  for (const calibrate::ExperimentEstimate& estimate : budget.estimates) {
    all_s += pace.at(estimate.experiment) *
             ((estimate.fit_runs + estimate.check_runs) * estimate.run_s + estimate.varied_s);
    column.runs.push_back(
        fmt::format("{} + {}", estimate.fit_runs, estimate.check_runs + estimate.varied_runs));
  }
  column.time = duration(all_s / jobs);
  return column;
}

/// What an hour more on all these cores is worth.
BudgetColumn hour_column(const BudgetPlan& budget, const AdaptiveTimestep& pace, int jobs) {
  calibrate::Problem problem = budget.problem;
  for (calibrate::Experiment& experiment : problem.experiments) {
    const auto found = pace.find(experiment.name);
    if (found != pace.end()) experiment.run_s *= found->second;
  }
  BudgetColumn column{.runs = {}, .time = duration(kHour_s)};
  for (const int runs : calibrate::runs_for(problem, kHour_s * jobs)) {
    column.runs.push_back(fmt::format("{}", runs));
  }
  column.runs.resize(budget.estimates.size(), "0");  // what is held out gets no more
  return column;
}

Table table_of(const std::vector<BudgetPlan>& budgets, const AdaptiveTimestep& pace, int jobs) {
  std::vector<Column> headings = {{.heading = ""}};
  std::vector<BudgetColumn> columns;
  for (const BudgetPlan& budget : budgets) {
    headings.push_back(number_column(budget.budget.name));
    columns.push_back(budget_column(budget, pace, jobs));
  }
  headings.push_back(number_column("one more hour"));
  columns.push_back(hour_column(budgets.back(), pace, jobs));
  Table table(headings);
  const std::vector<calibrate::ExperimentEstimate>& experiments = budgets.front().estimates;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    std::vector<std::string> row = {experiments[i].experiment};
    for (const BudgetColumn& column : columns) row.push_back(column.runs.at(i));
    table.add_row(row);
  }
  std::vector<std::string> times = {
      fmt::format("time at most, {} core{}", jobs, jobs == 1 ? "" : "s")};
  for (const BudgetColumn& column : columns) times.push_back(column.time);
  table.add_row(times);
  return table;
}

std::string page_of(const CalibratePlan& plan, const AdaptiveTimestep& pace, int columns) {
  const std::vector<BudgetPlan> budgets = {plan_of(plan, "quick"), plan_of(plan, "standard")};
  Page page(columns);
  page.add("Simulations of each experiment, for the fit + for the checks:");
  page.add_gap();
  page.add(table_of(budgets, pace, plan.threads));
  page.add_gap();
  for (const BudgetPlan& budget : budgets) {
    page.add(fmt::format("{}: {}.", budget.budget.name, budget.budget.description));
  }
  page.add("one more hour: additional runs within one hour, for comparison.");
  page.add(
      "The checks simulate the best fit with fresh seeds and, within a fifth of the budget each, "
      "with "
      "stiffer grains where the study's are softened and with more spheres where its shape "
      "allows.");
  page.add_gap();
  page.add(
      "Timed with one run of each experiment on this machine under its present load. A fit that "
      "converges early takes less; the computation between rounds is extra. Nothing was saved.");
  return page.text();
}

}  // namespace

ExitCode run_dry(const CalibratePlan& plan) {
  AdaptiveTimestep pace;
  try {
    pace = timed_pace(plan, estimate_of(plan.problem.problem, plan.record.budget),
                      watch_for_interrupt());
  } catch (const dem::Interrupted&) {
    print_line("interrupted; nothing was saved.");
    return ExitCode::interrupted;
  }
  Outputs outputs;
  outputs.show(page_of(plan, pace, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
