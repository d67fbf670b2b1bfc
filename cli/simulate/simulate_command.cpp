#include "cli/simulate/simulate_command.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "calibrate/simulators/simulators.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/simulate/simulate_output.h"
#include "cli/simulate/simulate_summary.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {
namespace {

/// "EXPERIMENT is drop (rebound height, mm), tilt (angle of sliding, deg)", and so on.
std::string experiment_notes() {
  constexpr std::size_t kColumns = 79;
  std::string text;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    const bool is_last = &entry == &dem::all_experiments().back();
    text += text.empty() ? "EXPERIMENT is " : is_last ? " or " : ", ";
    text += fmt::format("{} ({}, {})", entry.name, entry.value_name, entry.unit);
  }
  text += ". STUDY is a study file: samples/hazelnut/study.toml explains many of its keys.";
  return fmt::format("\n{}\n", fmt::join(base::wrapped(text, kColumns), "\n"));
}

constexpr const char* kSimulateNotes = R"(
A heap's final state is rendered as silhouettes from --views directions,
equally spaced over half a turn, each measured as repose measure does: 1 is the
XZ view alone, 0 renders none. If at least half of the views of a repeat could
be measured, its value is their mean, otherwise the angle from the grains'
positions; both are reported.

Each repeat has its own seed: --seed and the following numbers. The same seed
gives the same result with any number of threads. With --out, the same command
resumes an interrupted run.

Examples:
  repose simulate drop study.toml --repeats 10
  repose simulate heap study.toml --set contact.particle_wall.restitution=0.3
)";

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) names.emplace_back(entry.name);
  return names;
}

std::size_t count_done(const Repeats& repeats) {
  return static_cast<std::size_t>(std::ranges::count_if(
      repeats.runs, [](const calibrate::RunResult& run) { return run.failure.empty(); }));
}

/// What is available from a batch that gave no result.
std::string finished_text(const SimulatePlan& plan, const Repeats& repeats) {
  const std::size_t done = count_done(repeats);
  return fmt::format("{} of {} repeats were finished{}", done, plan.seeds.size(),
                     done > 0 && !plan.out_folder.empty()
                         ? "; their states are in " + plan.out_folder.string()
                         : "");
}

/// How to continue an interrupted batch.
std::string continue_text(const SimulatePlan& plan) {
  return plan.out_folder.empty() ? "Add --out FOLDER to make it resumable."
                                 : "The same command resumes from here.";
}

/// Why repeats gave no result, by seed. Input errors apply to every seed.
std::map<std::uint64_t, std::string> reasons_of(const Repeats& repeats) {
  std::map<std::uint64_t, std::string> reasons;
  for (std::size_t k = 0; k < repeats.runs.size(); ++k) {
    const calibrate::RunResult& run = repeats.runs[k];
    if (run.failure.empty()) continue;
    std::string& reason = reasons[run.seed];
    reason = fmt::format("seed {}: {}", run.seed, run.failure);
    const std::string& state = repeats.files[k].state;
    if (!state.empty()) {
      reason += fmt::format(" To look at it: repose render {} --out heap.png.", state);
    }
  }
  for (const RepeatError& error : repeats.errors) {
    reasons[error.seed] =
        error.is_internal ? fmt::format("seed {}: internal error: {}", error.seed, error.message)
                          : error.message;
  }
  return reasons;
}

/// Prints why there is no result, each reason once; for programs, if requested, also writes JSON
/// with a null value and the reasons.
ExitCode fail(const SimulatePlan& plan, const Repeats& repeats) {
  std::set<std::string> told;
  for (const auto& [seed, reason] : reasons_of(repeats)) {
    if (told.insert(reason).second) print_line(reason);
  }
  print_line("no result; " + finished_text(plan, repeats));
  if (std::ranges::any_of(repeats.errors, &RepeatError::is_internal)) {
    return ExitCode::internal_error;
  }
  if (!repeats.errors.empty()) return ExitCode::bad_input;
  if (!plan.json_file.empty()) {
    Outputs outputs;
    outputs.add(plan.json_file, simulate_json(plan, repeats));
    outputs.write();
  }
  return ExitCode::nothing_measurable;
}

Outputs results_of(const SimulatePlan& plan, const Repeats& repeats) {
  const std::string json = simulate_json(plan, repeats);
  Outputs outputs;
  if (!plan.out_folder.empty()) outputs.add(result_file(plan).string(), json);
  outputs.add(plan.json_file, json);
  outputs.show(simulate_table(plan, repeats.runs, columns_of(stdout)));
  return outputs;
}

/// Exit codes: 2 for a study or options that cannot be run; 3 (nothing measurable) when a run went
/// unstable or gave no reading: there is no result, and the mean of the other repeats would not be
/// one; 130 when interrupted. Then states of finished repeats are complete, but result.json and
/// --json are not written. With an --out folder the same call continues where it was interrupted,
/// to the same bytes.
ExitCode run_simulate(const SimulateArguments& arguments) {
  const SimulatePlan plan = plan_simulate(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const Repeats repeats = run_repeats(plan, is_interrupted);
  const bool is_all_done = count_done(repeats) == plan.seeds.size();
  if (is_interrupted && !is_all_done) {
    print_line(fmt::format("interrupted; no result was written; {}. {}",
                           finished_text(plan, repeats), continue_text(plan)));
    return ExitCode::interrupted;
  }
  if (!is_all_done) return fail(plan, repeats);
  Outputs outputs = results_of(plan, repeats);
  outputs.write_files();
  for (const RunWarning& warning : warnings_of(plan, repeats.runs)) {
    print_line((warning.seed ? fmt::format("seed {}: ", *warning.seed) : "") + warning.message);
  }
  outputs.write();
  return summarise(repeats.runs) ? ExitCode::done : ExitCode::nothing_measurable;
}

}  // namespace

Command simulate_command() {
  const auto given = std::make_shared<SimulateArguments>();
  return {
      .name = "simulate",
      .summary = "Simulate an experiment of a study",
      .options = {{.name = "experiment",
                   .value_name = "EXPERIMENT",
                   .help = "Experiment",
                   .target = &given->experiment,
                   .is_required = true,
                   .words = experiment_names()},
                  {"study", "STUDY.toml", "Study file", &given->study, true},
                  {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                   &given->settings},
                  {"--seed", "N", "Seed of the first repeat", &given->seed},
                  {"--repeats", "N", "Number of repeats, each with its own seed", &given->repeats},
                  {"--threads", "N", "Threads (all cores)", &given->threads},
                  {.name = "--engine",
                   .value_name = "NAME",
                   .help = "Program that simulates (repose)",
                   .target = &given->engine,
                   .words = calibrate::simulator_names()},
                  {"--processes", "N", "Processes of a run of that program (1)", &given->processes},
                  {"--out", "FOLDER", "Output folder; makes the run resumable", &given->out_folder},
                  {"--trajectory-s", "DT", "Save a frame every DT s of simulated time",
                   &given->trajectory_s},
                  {"--views", "N", "Views of each heap to measure (9)", &given->views},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = experiment_notes() + kSimulateNotes,
      .missing = "an experiment and a study file are needed. Fix: repose simulate heap STUDY.toml.",
      .run = [given] { return run_simulate(*given); }};
}

}  // namespace repose::cli
