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

/// "40 s", "12 min", "3.5 h".
std::string duration(double seconds) {
  constexpr double kMinute_s = 60;
  if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
  return fmt::format("{:.1f} h", seconds / kHour_s);
}

Table table_of(const calibrate::BudgetTimes& times) {
  std::vector<Column> headings = {{.heading = ""}};
  std::vector<std::string> last = {
      fmt::format("time at most, {} core{}", times.cores, times.cores == 1 ? "" : "s")};
  for (const calibrate::BudgetTime& time : times.budgets) {
    headings.push_back(number_column(time.budget.name));
    last.push_back(duration(time.seconds));
  }
  headings.push_back(number_column("one more hour"));
  last.push_back(duration(kHour_s));
  Table table(headings);
  for (std::size_t i = 0; i < times.hour_runs.size(); ++i) {
    std::vector<std::string> row = {times.budgets.front().experiments[i].experiment};
    for (const calibrate::BudgetTime& time : times.budgets) {
      const calibrate::ExperimentEstimate& estimate = time.experiments[i];
      row.push_back(
          fmt::format("{} + {}", estimate.fit_runs, estimate.check_runs + estimate.varied_runs));
    }
    row.push_back(fmt::format("{}", times.hour_runs[i]));
    table.add_row(row);
  }
  table.add_row(last);
  return table;
}

std::string page_of(const calibrate::BudgetTimes& times, int columns) {
  Page page(columns);
  page.add("Simulations of each experiment, for the fit + for the checks:");
  page.add_gap();
  page.add(table_of(times));
  page.add_gap();
  for (const calibrate::BudgetTime& time : times.budgets) {
    page.add(fmt::format("{}: {}.", time.budget.name, time.budget.description));
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
