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

/// In a calibration's folder: how far it is, and what `repose plan` says.
inline constexpr const char* kProgressFile = "progress.json";
inline constexpr const char* kPlanFile = "plan.json";

/// What is simulated for the folder's studies. Each task is the command line program, started as a
/// person would start it, one at a time; the others wait in the order in which they were asked for.
/// What a task has reached is in the folder of its calibration: it goes on there after it was
/// stopped or killed, and what the page is told of it is read there, whoever started it. Which
/// tasks are open stands in a file of the folder: the next studio goes on with them, however this
/// one ends.
///
/// Several threads may ask at once. All of it throws base::InputError for a study that is not
/// there.
class Calibrations {
 public:
  /// @param program  empty: nothing can be started
  Calibrations(const StudyFolder& studies, std::filesystem::path program);
  /// What runs is asked to end, and has ended.
  ~Calibrations();
  Calibrations(const Calibrations&) = delete;
  Calibrations& operator=(const Calibrations&) = delete;
  Calibrations(Calibrations&&) = delete;
  Calibrations& operator=(Calibrations&&) = delete;

  /// Of all studies: [{`study`, `task`, `state`, `command`, `seconds`, `lines`}], the running one
  /// first, then those that wait, then those that have ended, the last first. `state` is waiting,
  /// running, stopping, done, stopped or failed; `lines` are the last that the program has printed.
  Json tasks() const;
  /// Of one study: `study`, `folder`, `state` (none, running, unfinished, changed, finished),
  /// `runs` that are made, `is_elsewhere`, `progress`, `result`, `estimate`, `plan`, `files` that
  /// can be had, `targets` of exports, and its `tasks`.
  Json state(const std::string& study) const;

  /// @param task  "calibrate", "plan" or "estimate"
  /// @param amount  a calibration's budget; for how many minutes of a core a plan simulates; empty:
  ///   the usual one
  /// @throws base::InputError  there is no such task or amount, or it waits or runs already.
  void start(const std::string& study, const std::string& task, const std::string& amount);
  /// Asks the program to end, or takes it out of those that wait.
  /// @throws base::InputError  it neither runs nor waits.
  void stop(const std::string& study, const std::string& task);

  /// Runs `repose export` to its end: `command`, `is_done`, `lines` that it printed.
  Json exported(const std::string& study, const std::string& target, bool takes_approximate);

  /// The report of a study's folder, finished or not, as HTML.
  std::string report(const std::string& study);
  /// One of state()'s files. @throws base::InputError  it is none of them.
  std::string file(const std::string& study, const std::string& name) const;

 private:
  struct Task;

  /// Those of an earlier studio that had not come to their end.
  void take_up();
  /// Writes down what is open, for the next studio. @pre the mutex is held
  void write_down() const;
  std::shared_ptr<Task> task_of(const std::string& study, const std::string& name,
                                const std::string& amount) const;
  /// Behind those that are open. @pre as write_down()
  void open(const std::shared_ptr<Task>& task);
  void wait_for_earlier(const Task& task);
  void work();
  void carry_out(const std::shared_ptr<Task>& task);
  Json task_json(const Task& task) const;

  const StudyFolder& studies_;
  const std::filesystem::path program_;
  std::filesystem::path temporary_;  ///< for what programs print
  mutable std::mutex mutex_;
  std::mutex reporting_;
  std::condition_variable changed_;
  std::list<std::shared_ptr<Task>> open_;  ///< the first runs
  std::list<std::shared_ptr<Task>> ended_;
  std::map<std::string, Json> estimates_;
  int started_ = 0;
  bool is_ending_ = false;
  std::jthread worker_;
};

}  // namespace repose::studio
