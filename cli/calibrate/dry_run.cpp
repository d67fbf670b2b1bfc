#include "cli/calibrate/dry_run.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate/run/budget_times.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr double kHour_s = 3600;

/// "0.02 s", "7.3 s".
std::string run_duration(double seconds) { return fmt::format("{:.2g} s", seconds); }

/// "40 s", "12 min", "3.5 h".
std::string duration(double seconds) {
  constexpr double kMinute_s = 60;
  if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
  return fmt::format("{:.1f} h", seconds / kHour_s);
}

std::vector<Column> headings_of(const calibrate::BudgetTimes& times) {
  std::vector<Column> headings = {{.heading = ""}};
  for (const calibrate::BudgetTime& time : times.budgets) {
    headings.push_back(number_column(time.budget.name));
  }
  return headings;
}

/// By experiment.
Table runs_table(const calibrate::BudgetTimes& times) {
  std::vector<Column> headings = headings_of(times);
  headings.insert(headings.begin() + 1, number_column("a run"));
  headings.push_back(number_column("one more hour"));
  Table table(headings);
  for (std::size_t i = 0; i < times.hour_runs.size(); ++i) {
    std::vector<std::string> row = {times.budgets.front().experiments[i].experiment,
                                    run_duration(times.run_s[i])};
    for (const calibrate::BudgetTime& time : times.budgets) {
      const calibrate::ExperimentEstimate& estimate = time.experiments[i];
      row.push_back(
          fmt::format("{} + {}", estimate.fit_runs(), estimate.all().runs - estimate.fit_runs()));
    }
    row.push_back(fmt::format("{}", times.hour_runs[i]));
    table.add_row(row);
  }
  return table;
}

/// By purpose, in the order in which they are made.
Table phases_table(const calibrate::BudgetTimes& times) {
  constexpr double kPercent = 100;
  Table table(headings_of(times));
  for (const calibrate::Phase phase : calibrate::kPhases) {
    std::vector<std::string> row = {std::string(name_of(phase))};
    bool is_any = false;
    for (const calibrate::BudgetTime& time : times.budgets) {
      const auto found = time.phases.find(phase);
      const bool has_runs = found != time.phases.end() && found->second.runs > 0;
      row.push_back(has_runs ? fmt::format("{}, {} ({:.0f} %)", found->second.runs,
                                           duration(found->second.seconds),
                                           kPercent * found->second.seconds / time.seconds)
                             : "-");
      is_any = is_any || has_runs;
    }
    if (is_any) table.add_row(row);
  }
  std::vector<std::string> last = {
      fmt::format("time at most, {} core{}", times.cores, times.cores == 1 ? "" : "s")};
  for (const calibrate::BudgetTime& time : times.budgets) last.push_back(duration(time.seconds));
  table.add_row(last);
  return table;
}

std::string page_of(const calibrate::BudgetTimes& times, int columns) {
  Page page(columns);
  page.add("Simulations of each experiment, for the fit + for the checks:");
  page.add_gap();
  page.add(runs_table(times));
  page.add_gap();
  page.add("What they are for, how long that takes, and its share of the time:");
  page.add_gap();
  page.add(phases_table(times));
  page.add_gap();
  page.add("a run: on one core. one more hour: additional runs within one hour, for comparison.");
  page.add(
      "The checks simulate the best fit with fresh seeds; stiffer grains, more spheres and other "
      "inputs take at most a fifth of the fit's work each, where the study leaves them open.");
  page.add_gap();
  page.add(
      "Timed with one run of each experiment on this machine under its present load. A fit that "
      "converges early takes less; the computation between rounds is extra. Nothing was saved.");
  return page.text();
}

}  // namespace

ExitCode run_dry(const CalibratePlan& plan) {
  calibrate::BudgetTimes times;
  try {
    std::optional<Progress> progress;
    times =
        calibrate::budget_times(plan, watch_for_interrupt(), [&](std::size_t done, std::size_t of) {
          if (!progress) progress.emplace(of, "timed");
          if (done > 0) progress->advance();
        });
  } catch (const dem::Interrupted&) {
    print_line("interrupted; nothing was saved.");
    return ExitCode::interrupted;
  }
  Outputs outputs;
  outputs.add(plan.json_file, to_json(times));
  outputs.show(page_of(times, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
