#include "cli/simulate/simulate.h"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/simulate/simulate_folder.h"
#include "cli/simulate/simulate_json.h"
#include "cli/simulate/simulate_options.h"
#include "cli/simulate/simulate_runs.h"
#include "cli/simulate/simulate_table.h"
#include "cli/simulate/simulate_values.h"
#include "cli/simulate/simulate_warnings.h"

namespace repose::cli {
namespace {

std::size_t count(const std::vector<Run>& runs, RunOutcome outcome) {
  return static_cast<std::size_t>(std::count_if(
      runs.begin(), runs.end(), [&](const Run& run) { return run.outcome == outcome; }));
}

/// What is left of a batch that gave no result.
std::string finished_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const std::size_t done = count(runs, RunOutcome::done);
  return fmt::format("{} of {} repeats were finished{}", done, runs.size(),
                     done > 0 && !plan.out_folder.empty()
                         ? "; their states are in " + plan.out_folder.string()
                         : "");
}

/// How an interrupted batch goes on.
std::string continue_text(const SimulatePlan& plan) {
  return plan.out_folder.empty() ? "Add --out FOLDER to make it resumable."
                                 : "The same command resumes from here.";
}

/// Programs are told as well, where one asks: a value of null, and why.
void write_reasons(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const bool is_all_run =
      count(runs, RunOutcome::bad_input) + count(runs, RunOutcome::internal_error) == 0;
  if (!is_all_run || plan.json_file.empty()) return;
  Outputs outputs;
  outputs.add(plan.json_file, simulate_json(plan, runs));
  outputs.write();
}

/// Says why there is no result. What is wrong with the input is so for every seed, and told once.
ExitCode fail(const SimulatePlan& plan, const std::vector<Run>& runs) {
  std::set<std::string> told;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    std::string whose = fmt::format("seed {}: ", plan.seeds[k]);
    if (run.outcome == RunOutcome::internal_error) whose += "internal error: ";
    if (run.outcome == RunOutcome::bad_input) whose.clear();
    std::string line = whose + run.error;
    if (!run.state_file.empty() && run.outcome == RunOutcome::no_reading) {
      line += fmt::format(" To look at it: repose render {} --out heap.png.", run.state_file);
    }
    if (!run.error.empty() && told.insert(line).second) print_line(line);
  }
  print_line("no result; " + finished_text(plan, runs));
  write_reasons(plan, runs);
  if (count(runs, RunOutcome::internal_error) > 0) return ExitCode::internal_error;
  return count(runs, RunOutcome::bad_input) > 0 ? ExitCode::bad_input
                                                : ExitCode::nothing_measurable;
}

Outputs results_of(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const std::string json = simulate_json(plan, runs);
  Outputs outputs;
  if (!plan.out_folder.empty()) outputs.add(result_file(plan).string(), json);
  outputs.add(plan.json_file, json);
  outputs.show(simulate_table(plan, runs, columns_of(stdout)));
  return outputs;
}

}  // namespace

ExitCode run_simulate(const SimulateArguments& arguments) {
  const SimulatePlan plan = plan_simulate(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const std::vector<Run> runs = run_repeats(plan, is_interrupted);
  const bool is_all_done = count(runs, RunOutcome::done) == runs.size();
  if (is_interrupted && !is_all_done) {
    print_line(fmt::format("interrupted; no result was written; {}. {}", finished_text(plan, runs),
                           continue_text(plan)));
    return ExitCode::interrupted;
  }
  if (!is_all_done) return fail(plan, runs);
  Outputs outputs = results_of(plan, runs);
  outputs.write_files();
  for (const RunWarning& warning : warnings_of(plan, runs)) {
    print_line((warning.seed ? fmt::format("seed {}: ", *warning.seed) : "") + warning.message);
  }
  outputs.write();
  return summarise(runs) ? ExitCode::done : ExitCode::nothing_measurable;
}

}  // namespace repose::cli
