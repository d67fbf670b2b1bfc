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

/// A study from its file to its result: the work of `repose calibrate`.
namespace repose::calibrate {

/// What is calibrated, and how: the options of `repose calibrate`.
struct StudyRequest {
  std::filesystem::path study;
  std::vector<std::string> settings = {};  ///< overrides of the file, "key.path=value"
  std::string method = "joint";            ///< or "paper"
  Budget budget = budget_named("quick");
  std::optional<int> threads = {};    ///< std::nullopt: as the study says, or one per core
  std::filesystem::path folder = {};  ///< empty: default_folder()
};

/// Default folder of a calibration: STUDY_calibration, in the working directory.
std::filesystem::path default_folder(const std::filesystem::path& study_file);

/// Called with notes for the user, a sentence each.
using Note = std::function<void(const std::string& text)>;

/// Observers of a study, who may stop it. Null: none.
struct StudyWatch {
  std::function<void(const StudyProgress& progress)> report = {};
  Note note = {};
  const std::atomic<bool>* is_interrupted = nullptr;
};

/// Reads a study, measures its pictures and films, fits it, checks the fit in simulations, and
/// saves everything in the folder, result.json last: the input of `repose report`, `export` and
/// `simulate`. Simulations that the folder holds are not repeated.
/// @return  std::nullopt if interrupted; the same request resumes it. Meanwhile result.json has
/// what is known so far, if anything, marked provisional
/// @throws base::InputError  every error of the study, its sheets, pictures and films; a folder
///   with somebody's files, or that is in use by another process or cannot be written.
/// @throws std::runtime_error  this machine cannot render the pictures of heaps.
std::optional<StudyResult> run_study(const StudyRequest& request, const StudyWatch& watch = {});

/// A study that can be calibrated.
struct PreparedStudy {
  StudyRecord record;
  StudyProblem problem;
  int threads = 1;
  std::filesystem::path folder;
};

/// Error if the folder has files that repose did not write and that a calibration would overwrite.
std::optional<base::Fault> fault_of_folder(const std::filesystem::path& folder,
                                           const std::filesystem::path& study_file);

/// Before the folder becomes this study's: the result of another study, method or budget is kept as
/// "result_quick_1b9d6bcd.json", together with its heap, and this is noted.
/// @throws base::InputError  it cannot be renamed.
void set_aside_old_result(const std::filesystem::path& folder, const StudyIdentity& study,
                          const Note& note);

/// Makes the grain of a record whose study was read and whose bench was measured, and adds the
/// readings to the study.
/// @param notes  repairs, and remarks on the shape, are appended
/// @throws base::InputError  there is no such grain, or readings that no such bench can give.
void complete_record(StudyRecord& record, std::vector<std::string>& notes);

/// Finds the program requested by [engine] of a complete record.
/// @throws base::InputError  it is not there, or cannot simulate the study: every reason.
void choose_simulator(StudyRecord& record);

/// Number of runs that `threads` cores can make at once.
int runs_at_once(const PreparedStudy& study);

/// Makes the folder this study's. A result in it of another study, method or budget is renamed,
/// which is noted.
/// @throws base::InputError  the folder cannot be written.
void enter_folder(const PreparedStudy& study, const Note& note);

StudySimulator simulator_of(const PreparedStudy& study, const RunStore& store);

/// Fits and checks a study whose folder was entered, using the executor of the context, and saves
/// the heaps of the last check in the folder. std::nullopt if interrupted.
/// @throws base::InputError  as run_study().
std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyContext& context,
                                     const Note& note);

/// Enters the folder and does the same on threads of this process.
std::optional<StudyResult> fit_study(const PreparedStudy& study, const StudyWatch& watch);

}  // namespace repose::calibrate
