#pragma once

#include <condition_variable>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "studio/json_answer.h"
#include "studio/study_folder.h"

namespace repose::studio {

/// In a calibration's folder: its progress, and the output of `repose plan`.
inline constexpr const char* kProgressFile = "progress.json";
inline constexpr const char* kPlanFile = "plan.json";

/// Simulations for the folder's studies. Each task runs the command-line program as a user would,
/// one at a time; the others wait in the order in which they were requested. A task's progress is
/// stored in its calibration's folder: it resumes there after being stopped or killed, and the
/// page's information is read from there, whoever started it. Open tasks are listed in a file of
/// the folder: the next studio resumes them, however this one ends.
///
/// Thread-safe. All members throw base::InputError for an unknown study.
class Calibrations {
 public:
  /// @param program  empty: tasks cannot be started
  Calibrations(const StudyFolder& studies, std::filesystem::path program);
  /// Asks the running program to end, and waits for it.
  ~Calibrations();
  Calibrations(const Calibrations&) = delete;
  Calibrations& operator=(const Calibrations&) = delete;
  Calibrations(Calibrations&&) = delete;
  Calibrations& operator=(Calibrations&&) = delete;

  /// `tasks` of all studies, [{`study`, `task`, `state`, `command`, `seconds`, `end`, `lines`}]:
  /// the running one first, then those waiting, then those that ended, the latest first. `state` is
  /// waiting, running, stopping, done, stopped or failed; `lines` are the last that the program
  /// printed.
  Json tasks() const;
  /// Of one study: `study`, `folder`, `state` (none, running, unfinished, changed, finished),
  /// number of completed `runs`, `is_elsewhere`, `progress`, `result`, `estimate`, `plan`,
  /// downloadable `files`, export `targets`, and its `tasks`.
  Json state(const std::string& study) const;

  /// @param task  "calibrate", "plan" or "estimate"
  /// @param amount  a calibration's budget, or the core-minutes that a plan simulates; empty: the
  ///   default
  /// @throws base::InputError  unknown task, invalid amount, or it is already waiting or running.
  void start(const std::string& study, const std::string& task, const std::string& amount);
  /// Asks the program to end, or removes the task from the queue.
  /// @throws base::InputError  it is neither running nor waiting.
  void stop(const std::string& study, const std::string& task);

  /// Runs `repose export`, for a minute at most: `command`, `is_done`, `lines` that it printed.
  Json exported(const std::string& study, const std::string& target, bool takes_approximate);

  /// The report of a study's folder, finished or not, as HTML.
  std::string report(const std::string& study);
  /// One of state()'s files. @throws base::InputError  not one of them.
  std::string file(const std::string& study, const std::string& name) const;

 private:
  struct Task;

  /// Resumes the unfinished tasks of an earlier studio.
  void take_up();
  /// Saves the open tasks for the next studio. @pre the mutex is held
  void write_down() const;
  std::shared_ptr<Task> task_of(const std::string& study, const std::string& name,
                                const std::string& amount) const;
  /// Queues the task. @pre as write_down()
  void open(const std::shared_ptr<Task>& task);
  void wait_for_earlier(const Task& task);
  void work();
  void carry_out(const std::shared_ptr<Task>& task);
  Json task_json(const Task& task) const;

  const StudyFolder& studies_;
  const std::filesystem::path program_;
  std::filesystem::path temporary_;  ///< for the programs' output
  mutable std::mutex mutex_;
  std::mutex reporting_;
  std::condition_variable changed_;
  std::list<std::shared_ptr<Task>> open_;  ///< the first is running
  std::list<std::shared_ptr<Task>> ended_;
  std::map<std::string, Json> estimates_;
  int started_ = 0;
  bool is_ending_ = false;
  std::jthread worker_;
};

}  // namespace repose::studio
