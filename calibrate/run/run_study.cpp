#include "calibrate/run/run_study.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/info.h>

#include "base/atomic_file.h"
#include "base/folder_lock.h"
#include "calibrate/bench/read_bench.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/plan/offers.h"
#include "calibrate/published/published_method.h"
#include "calibrate/run/check_heaps.h"
#include "calibrate/simulators/simulators.h"
#include "calibrate/study/impossible_readings.h"
#include "calibrate/study/study_estimate.h"
#include "calibrate/study/study_run.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

void note_all(const Note& note, const std::vector<std::string>& lines) {
  if (!note) return;
  for (const std::string& line : lines) note(line);
}

/// Identifies the study of a result, for use in a file name.
std::string study_name(const std::optional<StudyIdentity>& study) {
  if (!study) return "unknown";
  return fmt::format("{}{}_{}", study->method == "joint" ? std::string() : study->method + '_',
                     study->budget.empty() ? "table" : study->budget,
                     study->hash.substr(0, study->hash.find('-')));
}

}  // namespace

void set_aside_old_result(const fs::path& folder, const StudyIdentity& study, const Note& note) {
  const fs::path file = folder / kResultFile;
  const auto text = base::read_file_if_there(file);
  if (!text) return;
  const auto old = study_in_result(*text);
  if (old && is_same_study(*old, study)) return;
  const std::string name = fmt::format("result_{}.json", study_name(old));
  const fs::path heap = folder / kHeapFile;
  std::error_code error;
  if (fs::exists(heap, error)) {
    fs::rename(heap, folder / fmt::format("heap_{}.vtp", study_name(old)), error);
  }
  if (!error) fs::rename(file, folder / name, error);
  if (error) {
    throw base::InputError(
        {.where = file.string(),
         .value =
             fmt::format("belongs to another study and cannot be renamed ({})", error.message()),
         .fix = "choose another folder."});
  }
  note_all(note, {fmt::format("{}: belonged to another study, settings or budget; renamed to {}",
                              file.string(), name)});
}

namespace {

/// Returns the result of `fitted`, after noting what was found damaged in the store.
template <typename Fitted>
auto with_remarks(const StudyContext& context, const Note& note, const Fitted& fitted) {
  auto outcome = fitted();
  note_all(note, context.folder.remarks());
  return outcome;
}

std::optional<StudyResult> fit_as_published(const PreparedStudy& study, const StudyContext& context,
                                            const Note& note) {
  const auto outcome = with_remarks(
      context, note, [&] { return calibrate_as_published(study.problem.problem, context); });
  if (!outcome) return std::nullopt;
  save_check_heaps(study.folder, context, outcome->checks);
  return result_of(study.record, study.problem, *outcome);
}

bool has_final_result(const fs::path& folder) {
  try {
    const auto result = read_result(folder);
    return result && !is_provisional(*result);
  } catch (const base::InputError&) {
    return false;  // damaged
  }
}

/// Takes the place of a result, but not of a final one of the same study whose runs were lost.
void leave_provisional(const PreparedStudy& study, const StudyResult& result, const Note& note) {
  if (has_final_result(study.folder)) return;
  const fs::path file = study.folder / kResultFile;
  try {
    base::write_whole_file(file, to_json(result));
  } catch (const base::InputError& error) {
    note_all(note, {error.what()});  // it was interrupted anyway, and its runs are saved
    return;
  }
  note_all(note, {fmt::format("{}: provisional, what is known so far", file.string())});
}

std::optional<StudyResult> fit_jointly(const PreparedStudy& study, const StudyContext& context,
                                       const Note& note) {
  Problem problem = study.problem.problem;
  // Includes runs that plans have left in the folder, which are those of our own engine.
  if (study.record.study.engine.is_own()) {
    problem.offers = offers_in(context.folder, study.record.study, study.record.grain);
  }
  note_all(note, {foreseen(estimate_of(problem, study.record.budget))});
  StudyContext with_leave = context;
  with_leave.leave = [&](const ProvisionalOutcome& known) {
    leave_provisional(study, result_of(study.record, study.problem, known), note);
  };
  const auto outcome = with_remarks(
      context, note, [&] { return run_study(problem, study.record.budget, with_leave); });
  if (!outcome) return std::nullopt;
  if (outcome->reused > 0) {
    note_all(note,
             {fmt::format("{} of {} simulations were taken from {}", outcome->reused,
                          outcome->reused + outcome->simulated, context.folder.runs().string())});
  }
  note_all(note, outcome->notes);
  note_all(note, outcome->fit.warnings);
  save_check_heaps(study.folder, context, outcome->checks);
  return result_of(study.record, study.problem, *outcome);
}

PreparedStudy prepared(const StudyRequest& request, const Note& note) {
  PreparedStudy study;
  StudyRecord& record = study.record;
  record.settings = request.settings;
  record.method = request.method;
  record.budget = request.budget;
  record.budget.is_full = request.budget.is_full || request.method == "paper";
  record.study = dem::read_study(request.study, request.settings);
  study.threads =
      request.threads.value_or(record.study.threads.value_or(tbb::info::default_concurrency()));
  study.folder = request.folder.empty() ? default_folder(request.study) : request.folder;
  base::Faults faults;
  faults.require(
      request.method == "joint" || request.method == "paper",
      {.subject = "method", .value = request.method, .rule = "joint or paper", .fix = "joint."});
  faults.require(study.threads >= 1, {.subject = "threads",
                                      .value = fmt::format("{}", study.threads),
                                      .rule = "1 or more",
                                      .fix = "leave it out to use all cores."});
  if (auto fault = fault_of_folder(study.folder, request.study)) faults.add(std::move(*fault));
  std::vector<std::string> notes;
  try {
    const BenchOptions options{.threads = std::max(1, study.threads)};
    record.measurement = read_bench(record.study, options, notes);
  } catch (const base::InputError& error) {
    faults.add_all(error.faults());
  }
  faults.throw_if_any();
  complete_record(record, notes);
  choose_simulator(record);
  study.problem = problem_of(record.study, record.grain, record.budget);
  note_all(note, notes);
  note_all(note, study.problem.notes);
  return study;
}

}  // namespace

fs::path default_folder(const fs::path& study_file) {
  return study_file.stem().string() + "_calibration";
}

std::optional<base::Fault> fault_of_folder(const fs::path& folder, const fs::path& study_file) {
  const std::vector<std::string> foreign = foreign_files(folder, study_file);
  if (foreign.empty()) return std::nullopt;
  return base::Fault{
      .where = folder.string(),
      .value = fmt::format(
          "not a folder of repose calibrate, and your own files there would be overwritten: {}",
          fmt::join(foreign, ", ")),
      .fix = "choose another folder, or move them away."};
}

void complete_record(StudyRecord& record, std::vector<std::string>& notes) {
  record.grain = dem::build_grain(record.study.grain);
  record.study = as_measured(std::move(record.study), record.grain.shape, record.measurement);
  base::Faults faults;
  faults.add_all(impossible_readings(record.study, record.grain.shape));
  faults.throw_if_any();
  for (const std::string& repair : record.grain.repairs) {
    notes.push_back(fmt::format("{}: {}", record.grain.source, repair));
  }
  const std::string shape = dem::warning_of_shape(record.grain);
  if (!shape.empty()) notes.push_back(shape);
}

void choose_simulator(StudyRecord& record) {
  record.simulator = simulator_for(record.study);
  if (record.study.engine.is_own()) return;
  record.simulator_differences = check_for_fit(*record.simulator, record.study, record.grain.shape);
}

int runs_at_once(const PreparedStudy& study) {
  return std::max(1, study.threads / study.record.study.engine.processes);
}

void enter_folder(const PreparedStudy& study, const Note& note) {
  set_aside_old_result(study.folder, identity_of(study.record), note);
  write_study_record(study.folder, study.record);
}

StudySimulator simulator_of(const PreparedStudy& study, const RunStore& store) {
  StudySimulator simulator(study.record.study, study.record.grain,
                           study.problem.problem.parameters);
  simulator.store_in(store);
  simulator.use(study.record.simulator);
  return simulator;
}

std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyContext& context,
                                     const Note& note) {
  return study.record.method == "paper" ? fit_as_published(study, context, note)
                                        : fit_jointly(study, context, note);
}

std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyWatch& watch) {
  const RunStore store(study.folder);
  const base::FolderLock lock(study.folder, lock_file_in(study.folder));
  enter_folder(study, watch.note);
  const StudySimulator simulator = simulator_of(study, store);
  ThreadExecutor executor(simulator, runs_at_once(study));
  const std::atomic<bool> never = false;
  StudyContext context{simulator, store, executor,
                       watch.is_interrupted != nullptr ? *watch.is_interrupted : never};
  if (watch.report) context.report = watch.report;
  return fit_study(study, context, watch.note);
}

std::optional<StudyResult> run_study(const StudyRequest& request, const StudyWatch& watch) {
  const PreparedStudy study = prepared(request, watch.note);
  std::optional<StudyResult> result = fit_study(study, watch);
  if (result) base::write_whole_file(study.folder / kResultFile, to_json(*result));
  return result;
}

}  // namespace repose::calibrate
