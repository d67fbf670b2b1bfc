#include "cli/calibrate/calibrate.h"

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/folder_lock.h"
#include "base/whole_file.h"
#include "calibrate/experiment/run_folder.h"
#include "calibrate/plan/offers.h"
#include "calibrate/result/result.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_record.h"
#include "calibrate/study/study_run.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/calibrate/calibrate_progress.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/calibrate/check_heaps.h"
#include "cli/calibrate/dry_run.h"
#include "cli/calibrate/paper_table.h"
#include "cli/calibrate/rolling_models.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// What of a result tells whose it is, for the name of a file.
std::string study_name(const std::optional<calibrate::StudyIdentity>& study) {
  if (!study) return "unknown";
  return fmt::format("{}{}_{}", study->method == "joint" ? std::string() : study->method + '_',
                     study->budget, study->hash.substr(0, study->hash.find('-')));
}

/// Before the folder is this study's: the result of another study, method or budget stays, as
/// "result_quick_1b9d6bcd.json", and the heap that belongs to it.
void set_aside_old_result(const CalibratePlan& plan) {
  const fs::path file = plan.out_folder / calibrate::kResultFile;
  const auto text = base::read_file_if_there(file);
  if (!text) return;
  const auto old = calibrate::study_in_result(*text);
  if (old && is_same_study(*old, identity_of(plan.record))) return;
  const std::string name = fmt::format("result_{}.json", study_name(old));
  const fs::path heap = plan.out_folder / calibrate::kHeapFile;
  std::error_code error;
  if (fs::exists(heap, error)) {
    fs::rename(heap, plan.out_folder / fmt::format("heap_{}.vtp", study_name(old)), error);
  }
  if (!error) fs::rename(file, plan.out_folder / name, error);
  if (error) {
    throw base::InputError(
        {.where = file.string(),
         .value =
             fmt::format("belongs to another study and cannot be renamed ({})", error.message()),
         .fix = "choose another folder."});
  }
  print_line(fmt::format("{}: belonged to another study, settings or budget; renamed to {}",
                         file.string(), name));
}

/// The folder becomes this study's.
void enter_folder(const CalibratePlan& plan) {
  set_aside_old_result(plan);
  calibrate::write_study_record(plan.out_folder, plan.record);
}

void write_results(const CalibratePlan& plan, const calibrate::StudyResult& result,
                   const std::string& table) {
  const std::string json = to_json(result);
  Outputs outputs;
  outputs.add((plan.out_folder / calibrate::kResultFile).string(), json);
  outputs.add(plan.json_file, json);
  outputs.show(table);
  outputs.write();
}

calibrate::StudySimulator simulator_of(const CalibratePlan& plan,
                                       const calibrate::RunFolder& folder) {
  calibrate::StudySimulator simulator(plan.record.study, plan.record.grain,
                                      plan.problem.problem.parameters);
  simulator.store_in(folder);
  return simulator;
}

ExitCode interrupted(const calibrate::RunFolder& folder) {
  print_line(
      fmt::format("interrupted; no result was written. The same command resumes from here: the "
                  "simulations are in {}.",
                  folder.runs().string()));
  return ExitCode::interrupted;
}

/// What `study` returns; its progress is shown meanwhile.
template <class Study>
auto with_progress(calibrate::StudyContext context, Study study) {
  auto outcome = [&] {
    StudyProgressLine line;
    context.report = [&](const calibrate::StudyProgress& progress) { line.report(progress); };
    return study(context);
  }();
  print_lines(context.folder.remarks());
  return outcome;
}

ExitCode run_as_published(const CalibratePlan& plan, const calibrate::StudyContext& context) {
  const auto outcome = with_progress(context, [&](const calibrate::StudyContext& shown) {
    return calibrate_as_published(plan.problem.problem, shown);
  });
  if (!outcome) return interrupted(context.folder);
  save_check_heaps(plan, context, outcome->checks);
  const calibrate::StudyResult result = result_of(plan.record, plan.problem, *outcome);
  write_results(plan, result,
                paper_table(std::get<calibrate::PublishedResult>(result.found), plan.record.study,
                            columns_of(stdout)));
  return ExitCode::done;
}

/// With what plans have left in the folder.
calibrate::Problem advised_problem(const CalibratePlan& plan, const calibrate::RunFolder& folder) {
  calibrate::Problem problem = plan.problem.problem;
  problem.offers = calibrate::offers_in(folder, plan.record.study, plan.record.grain);
  return problem;
}

/// The whole study, from rank 0 where there are ranks.
ExitCode run_study_with(const CalibratePlan& plan, const calibrate::StudyContext& context) {
  if (plan.record.method == "paper") return run_as_published(plan, context);
  const calibrate::Problem problem = advised_problem(plan, context.folder);
  const auto outcome = with_progress(context, [&](const calibrate::StudyContext& shown) {
    return run_study(problem, plan.record.budget, shown);
  });
  if (!outcome) return interrupted(context.folder);
  if (outcome->reused > 0) {
    print_lines(
        {fmt::format("{} of {} simulations were taken from {}", outcome->reused,
                     outcome->reused + outcome->simulated, context.folder.runs().string())});
  }
  print_lines(outcome->notes);
  print_lines(outcome->fit.warnings);
  save_check_heaps(plan, context, outcome->checks);
  const calibrate::StudyResult result = result_of(plan.record, plan.problem, *outcome);
  write_results(plan, result,
                joint_table(std::get<calibrate::JointResult>(result.found), result.provenance,
                            columns_of(stdout)));
  return ExitCode::done;
}

/// As one of the processes of an MPI job.
ExitCode run_as_rank(const CalibrateArguments& arguments) {
  const calibrate::RankSession session;
  const CalibratePlan plan = plan_calibrate(arguments);
  if (session.rank() == 0) print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  const calibrate::RunFolder folder(plan.out_folder);
  const calibrate::StudySimulator simulator = simulator_of(plan, folder);
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  if (session.rank() > 0) {
    session.serve(simulator, is_interrupted);
    return ExitCode::done;
  }
  print_lines(plan.notes);
  const base::FolderLock lock(plan.out_folder, calibrate::lock_file_in(plan.out_folder));
  enter_folder(plan);
  calibrate::RankExecutor executor(session, simulator);
  return run_study_with(plan, {simulator, folder, executor, is_interrupted});
}

}  // namespace

ExitCode run_calibrate(const CalibrateArguments& arguments) {
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
  const CalibratePlan plan = plan_calibrate(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);
  if (arguments.is_dry_run) return run_dry(plan);
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const calibrate::RunFolder folder(plan.out_folder);
  const base::FolderLock lock(plan.out_folder, calibrate::lock_file_in(plan.out_folder));
  enter_folder(plan);
  const calibrate::StudySimulator simulator = simulator_of(plan, folder);
  calibrate::ThreadExecutor executor(simulator, plan.jobs);
  return run_study_with(plan, {simulator, folder, executor, is_interrupted});
}

}  // namespace repose::cli
