#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/result/result.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/job_runner.h"
#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_record.h"

/// A study from its file to its result: what `repose calibrate` does.
namespace repose::calibrate {

/// What is calibrated, and how: the options of `repose calibrate`.
struct StudyRequest {
  std::filesystem::path study;
  std::vector<std::string> settings = {};  ///< "key.path=value" pairs laid over the file
  std::string method = "joint";            ///< or "paper"
  Budget budget = budget_named("quick");
  std::optional<int> threads = {};    ///< none: as many as the study says, or one a core
  std::filesystem::path folder = {};  ///< empty: default_folder()
};

/// Where a study is calibrated if nothing else is said: STUDY_calibration, here.
std::filesystem::path default_folder(const std::filesystem::path& study_file);

/// Hears of what a person should know, a sentence each.
using Note = std::function<void(const std::string& text)>;

/// Who watches a study, and may stop it. Null: nobody.
struct StudyWatch {
  std::function<void(const StudyProgress& progress)> report = {};
  Note note = {};
  const std::atomic<bool>* is_interrupted = nullptr;
};

/// Reads a study, measures its pictures and films, fits it, checks the fit in simulations, and
/// leaves everything in the folder, result.json last: what `repose report`, `export` and `simulate`
/// read. Simulations that the folder holds are not made again.
/// @return  none when it was interrupted; the same request goes on from there. Meanwhile
///   result.json is what is known, marked provisional, where that is anything
/// @throws base::InputError  every error of the study, its sheets, pictures and films; a folder
///   with somebody's files, or that another process has or that cannot be written.
/// @throws std::runtime_error  this machine cannot draw the pictures of heaps.
std::optional<StudyResult> run_study(const StudyRequest& request, const StudyWatch& watch = {});

/// A study that can be calibrated.
struct PreparedStudy {
  StudyRecord record;
  StudyProblem problem;
  int threads = 1;
  std::filesystem::path folder;
};

/// Where there are files in the folder that no repose wrote and that a calibration would overwrite.
std::optional<base::Fault> fault_of_folder(const std::filesystem::path& folder,
                                           const std::filesystem::path& study_file);

/// Before the folder is this study's: the result of another study, method or budget stays, as
/// "result_quick_1b9d6bcd.json", and the heap that belongs to it, which is noted.
/// @throws base::InputError  it cannot be renamed.
void set_aside_old_result(const std::filesystem::path& folder, const StudyIdentity& study,
                          const Note& note);

/// Makes the grain of a record whose study was read and whose bench was measured, and takes the
/// readings into the study.
/// @param notes  what was repaired, and what to know of the shape, is added
/// @throws base::InputError  there is no such grain, or readings that no such bench gives.
void complete_record(StudyRecord& record, std::vector<std::string>& notes);

/// Finds the program that [engine] of a complete record asks for.
/// @throws base::InputError  it is not there, or cannot simulate the study: every reason.
void choose_simulator(StudyRecord& record);

/// How many runs `threads` cores are enough for at once.
int runs_at_once(const PreparedStudy& study);

/// The folder becomes this study's. The result of another study, method or budget that it holds
/// gets another name, which is noted.
/// @throws base::InputError  the folder cannot be written.
void enter_folder(const PreparedStudy& study, const Note& note);

StudySimulator simulator_of(const PreparedStudy& study, const RunStore& store);

/// Fits and checks a study whose folder was entered, by the executor of the context, and leaves the
/// heaps of the last check in the folder. None when it was interrupted.
/// @throws base::InputError  as run_study().
std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyContext& context,
                                     const Note& note);

/// Enters the folder and does the same on threads of this process.
std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyWatch& watch);

}  // namespace repose::calibrate
