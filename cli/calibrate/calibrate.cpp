#include "cli/calibrate/calibrate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folder_lock.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/plan/offers.h"
#include "calibrate/result/result.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_record.h"
#include "calibrate/study/study_run.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/calibrate/dry_run.h"
#include "cli/calibrate/paper_table.h"
#include "cli/calibrate/rolling_models.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "dem/state/state_file.h"

namespace repose::cli {

void StudyProgressLine::report(const calibrate::StudyProgress& progress) {
  const bool is_new = progress.stage != stage_;
  if (is_new) earlier_s_ += stage_s_;
  stage_ = progress.stage;
  stage_s_ = progress.seconds_done;
  const double all_s = earlier_s_ + progress.seconds_of + progress.seconds_later.value_or(0);
  const bool is_known = progress.seconds_later && all_s > 0;
  const double fraction = is_known ? (earlier_s_ + stage_s_) / all_s : 0;
  if (is_new) {
    line_.show_next();
    if (!line_.is_shown()) {
      print_error_text(fmt::format("{}: {} simulations{}\n", progress.stage, progress.of,
                                   line_.left_text(fraction)));
    }
  }
  line_.report(fmt::format("{}: {} of {} simulations", progress.stage, progress.done, progress.of),
               fraction);
}

namespace {

namespace fs = std::filesystem;

/// Only what repose wrote.
void remove_heap(const fs::path& file) {
  std::error_code ignored;
  if (dem::is_as_written(file)) fs::remove(file, ignored);
}

void remove_earlier_heaps(const fs::path& folder) {
  remove_heap(folder / calibrate::kHeapFile);
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder / calibrate::kHeapsFolder, error), end;
       !error && entry != end; entry.increment(error)) {
    files.push_back(entry->path());
  }
  for (const fs::path& file : files) remove_heap(file);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  base::refuse(folder, fmt::format("cannot be created ({})", error.message()),
               "get permission to write there, or move away what has that name.");
}

}  // namespace

std::size_t most_typical(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / std::ssize(values);
  const auto nearest = std::min_element(values.begin(), values.end(), [mean](double a, double b) {
    return std::abs(a - mean) < std::abs(b - mean);
  });
  return static_cast<std::size_t>(nearest - values.begin());
}

void save_check_heaps(const CalibratePlan& plan, const calibrate::StudyContext& context,
                      const std::vector<calibrate::Run>& checks) {
  remove_earlier_heaps(plan.out_folder);
  const auto copy_to = [&](const calibrate::Job& job, const fs::path& name) {
    return context.folder.copy_state(context.simulator.spec(job), job.seed, name.string());
  };
  std::vector<calibrate::Job> saved;
  std::vector<double> angles;
  for (const calibrate::Run& run : checks) {
    if (run.job.experiment != "heap" || !run.failure.empty()) continue;
    make_folder(plan.out_folder / calibrate::kHeapsFolder);
    const std::string name = fmt::format("heap_seed_{}.vtp", run.job.seed);
    if (!copy_to(run.job, fs::path(calibrate::kHeapsFolder) / name)) continue;
    saved.push_back(run.job);
    angles.push_back(run.readings.at("value"));
  }
  if (!saved.empty()) copy_to(saved[most_typical(angles)], calibrate::kHeapFile);
}

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
                                       const calibrate::RunStore& folder) {
  calibrate::StudySimulator simulator(plan.record.study, plan.record.grain,
                                      plan.problem.problem.parameters);
  simulator.store_in(folder);
  return simulator;
}

ExitCode interrupted(const calibrate::RunStore& folder) {
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
calibrate::Problem advised_problem(const CalibratePlan& plan, const calibrate::RunStore& folder) {
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
  const calibrate::RunStore folder(plan.out_folder);
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
  const calibrate::RunStore folder(plan.out_folder);
  const base::FolderLock lock(plan.out_folder, calibrate::lock_file_in(plan.out_folder));
  enter_folder(plan);
  const calibrate::StudySimulator simulator = simulator_of(plan, folder);
  calibrate::ThreadExecutor executor(simulator, plan.jobs);
  return run_study_with(plan, {simulator, folder, executor, is_interrupted});
}

}  // namespace repose::cli
