#include "cli/calibrate/calibrate.h"

#include <atomic>
#include <cstdio>
#include <optional>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "base/folder_lock.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/result/result.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate_engine.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/calibrate/calibrate_runs.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/calibrate/dry_run.h"
#include "cli/calibrate/paper_table.h"
#include "cli/calibrate/rolling_models.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {

void StudyProgressLine::report(const calibrate::StudyProgress& progress) {
  work_.add(progress);
  const double fraction = work_.fraction();
  if (work_.is_new_stage()) {
    line_.show_next();
    if (!line_.is_shown()) {
      print_error_text(fmt::format("{}: {} simulations{}\n", progress.stage, progress.of,
                                   line_.left_text(fraction)));
    }
  }
  line_.report(fmt::format("{}: {} of {} simulations", progress.stage, progress.done, progress.of),
               fraction);
}

StudyMessages::StudyMessages(const CalibratePlan& plan)
    : parameters_(plan.problem.problem.parameters), file_(plan.progress_file, parameters_) {}

/// Reports the last completed round, once.
void StudyMessages::tell_round(const calibrate::StudyProgress& progress) {
  if (progress.rounds.size() <= rounds_told_) return;
  rounds_told_ = progress.rounds.size();
  const calibrate::RoundSummary& round = progress.rounds.back();
  std::string values;
  for (std::size_t k = 0; k < parameters_.size() && k < round.intervals.size(); ++k) {
    values += fmt::format("{}{} {:.3g} ({:.3g} to {:.3g})", values.empty() ? "" : ", ",
                          short_name(parameters_[k].name), round.values[k], round.intervals[k].low,
                          round.intervals[k].high);
  }
  line_.reset();
  print_line(fmt::format("after round {}, provisional (95 %): {}", rounds_told_, values));
}

calibrate::StudyWatch StudyMessages::watch(const std::atomic<bool>& is_interrupted) {
  return {.report =
              [this](const calibrate::StudyProgress& progress) {
                tell_round(progress);
                if (!line_) line_.emplace();
                line_->report(progress);
                file_.report(progress);
              },
          .note =
              [this](const std::string& text) {
                line_.reset();
                print_line(text);
                file_.note(text);
              },
          .is_interrupted = &is_interrupted};
}

namespace {

std::string table_of(const CalibratePlan& plan, const calibrate::StudyResult& result) {
  if (const auto* paper = std::get_if<calibrate::PublishedResult>(&result.found)) {
    return paper_table(*paper, plan.record.study, columns_of(stdout));
  }
  return joint_table(std::get<calibrate::JointResult>(result.found), result.provenance,
                     columns_of(stdout));
}

/// The provisional result of an interrupted study; std::nullopt if there is none yet.
std::optional<calibrate::StudyResult> provisional_in(const CalibratePlan& plan) {
  try {
    auto left = calibrate::read_result(plan.folder);
    if (left && is_provisional(*left) &&
        is_same_study(left->provenance.study, identity_of(plan.record))) {
      return left;
    }
    return std::nullopt;
  } catch (const base::InputError&) {
    return std::nullopt;  // a damaged one does not count
  }
}

ExitCode finish_interrupted(const CalibratePlan& plan) {
  const auto provisional = provisional_in(plan);
  print_line(
      fmt::format("interrupted; {}. The same command resumes from here: the simulations are in {}.",
                  provisional ? "the result is provisional" : "no result was written",
                  (plan.folder / "runs").string()));
  if (!provisional) return ExitCode::interrupted;
  Outputs outputs;
  outputs.add(plan.json_file, to_json(*provisional));
  outputs.show(table_of(plan, *provisional));
  outputs.write();
  return ExitCode::interrupted;
}

/// Writes and shows the result, or reports the interruption.
ExitCode finish(const CalibratePlan& plan, const std::optional<calibrate::StudyResult>& result) {
  if (!result) return finish_interrupted(plan);
  const std::string json = to_json(*result);
  Outputs outputs;
  outputs.add((plan.folder / calibrate::kResultFile).string(), json);
  outputs.add(plan.json_file, json);
  outputs.show(table_of(plan, *result));
  outputs.write();
  return ExitCode::done;
}

/// Runs `fit` and returns its result, showing its messages meanwhile.
template <typename Fit>
std::optional<calibrate::StudyResult> with_messages(const CalibratePlan& plan, const Fit& fit) {
  StudyMessages messages(plan);
  return fit(messages.watch(watch_for_interrupt()));
}

/// Runs as one of the processes of an MPI job.
ExitCode run_as_rank(const CalibrateArguments& arguments) {
  const calibrate::RankSession session;
  const CalibratePlan plan = plan_calibrate(arguments);
  const bool is_own = plan.record.study.engine.is_own();
  if (session.rank() == 0) {
    print_lines(plan.errors);
    if (!is_own) {
      print_line(
          "[engine]: a program that starts processes of its own cannot be started by one of "
          "several "
          "of an MPI job. Fix: start repose as one process, without mpirun or srun.");
    }
  }
  if (!is_own) return ExitCode::bad_input;
  if (!plan.errors.empty()) return ExitCode::bad_input;
  const calibrate::RunStore store(plan.folder);
  const calibrate::StudySimulator simulator = simulator_of(plan, store);
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  if (session.rank() > 0) {
    session.serve(simulator, is_interrupted);
    return ExitCode::done;
  }
  print_lines(plan.notes);
  const base::FolderLock lock(plan.folder, calibrate::lock_file_in(plan.folder));
  calibrate::RankExecutor executor(session, simulator);
  return finish(plan, with_messages(plan, [&](const calibrate::StudyWatch& watch) {
                  enter_folder(plan, watch.note);
                  return fit_study(plan, {simulator, store, executor, is_interrupted, watch.report},
                                   watch.note);
                }));
}

}  // namespace

namespace {

/// Runs the simulations in this process.
ExitCode run_here(const CalibrateArguments& arguments) {
  const CalibratePlan plan = plan_calibrate(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);
  if (arguments.is_dry_run) return run_dry(plan);
  return finish(plan, with_messages(plan, [&](const calibrate::StudyWatch& watch) {
                  return fit_study(plan, watch);
                }));
}

}  // namespace

ExitCode run_calibrate(const CalibrateArguments& arguments) {
  if (has_engine(arguments)) return run_calibrate_engine(arguments);
  if (!arguments.runs.empty()) return run_calibrate_runs(arguments);
  if (!arguments.max_runs.empty()) {
    print_line(calibrate::is_table_study(arguments.study)
                   ? "--max-runs: is for studies with [engine], whose command makes runs; this one "
                     "has none. Fix: add it, or give runs with --runs."
                   : "--max-runs: is for studies with [parameter] and [engine], whose runs another "
                     "program makes; this one repose simulates itself. Fix: leave it out, and "
                     "[engine] where there is one; --budget limits simulations.");
    return ExitCode::bad_input;
  }
  if (!arguments.rolling_models.empty()) return run_rolling_models(arguments);
  if (calibrate::is_launched_as_rank()) {
    if (arguments.is_dry_run) {
      print_line(
          "--dry-run: times this machine only. Fix: start it as one process, without mpirun.");
      return ExitCode::bad_input;
    }
    if (calibrate::has_ranks()) return run_as_rank(arguments);
    print_lines(
        {"started as several processes, but built without MPI: each would do the whole "
         "study. Fix: install MPI (libopenmpi-dev) and rebuild, or start one "
         "process with --jobs."});
    return ExitCode::bad_input;
  }
  try {
    return run_here(arguments);
  } catch (const dem::Interrupted&) {
    print_line("interrupted while it was timed; nothing was saved.");
    return ExitCode::interrupted;
  }
}

}  // namespace repose::cli
