#include "studio/calibrations.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/folder_lock.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/statistics/table/table.h"
#include "calibrate/study/study_problem.h"

namespace repose::studio {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kTasksFile = ".repose-studio.tasks";
constexpr std::size_t kLines = 30;      // of a program's output
constexpr std::size_t kMostEnded = 50;  // tasks that are remembered
constexpr std::size_t kMostWaiting = 50;
constexpr std::chrono::milliseconds kLook{100};
constexpr std::chrono::seconds kPatience{20};  // for a program that was asked to end
constexpr int kInterrupted = 130;              // the program's exit code

std::string command_of(const std::vector<std::string>& words) {
  std::string line = "repose";
  for (const std::string& word : words) line += ' ' + base::shell_word(word);
  return line;
}

/// A program's messages, without its name before each line.
std::vector<std::string> said_in(const fs::path& output) {
  constexpr std::string_view kName = "repose: ";
  std::vector<std::string> lines = base::last_lines(output, kLines);
  for (std::string& line : lines) {
    if (line.starts_with(kName)) line.erase(0, kName.size());
  }
  return lines;
}

/// As an argument, so that no name is mistaken for an option.
std::string argument_of(const std::string& study) {
  return study.starts_with('-') ? "./" + study : study;
}

}  // namespace

struct Calibrations::Task {
  std::string study;
  std::string name;
  std::string amount;
  std::vector<std::string> words;  ///< as a user would type them
  std::vector<std::string> extra;  ///< for this page
  fs::path output;
  fs::path estimate;         ///< of an estimate
  bool is_given_up = false;  ///< the user has stopped it
  bool is_taken_up = false;  ///< resumed from an earlier studio
  std::string state = "waiting";
  std::string end;                 ///< how it ended, if abnormally
  std::vector<std::string> lines;  ///< once it has ended
  Clock::time_point since = Clock::now();
  double seconds = 0;  ///< once it has ended
};

Calibrations::Calibrations(const StudyFolder& studies, fs::path program)
    : studies_(studies), program_(std::move(program)) {
  std::string name = (fs::temp_directory_path() / "repose-studio-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), name);
  }
  temporary_ = name;
  take_up();
  worker_ = std::jthread([this] { work(); });
}

Calibrations::~Calibrations() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  worker_.join();
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void Calibrations::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || !open_.empty(); });
    if (is_ending_) return;
    const std::shared_ptr<Task> task = open_.front();
    task->state = "running";
    task->since = Clock::now();
    lock.unlock();
    carry_out(task);
    lock.lock();
    // The next studio resumes tasks that were stopped because this one is ending.
    if (is_ending_ && task->state == "stopped" && !task->is_given_up) return;
    open_.pop_front();
    write_down();
    ended_.push_front(task);
    if (ended_.size() > kMostEnded) ended_.pop_back();
  }
}

/// Returns when the program has ended, on its own or on request.
void Calibrations::carry_out(const std::shared_ptr<Task>& task) {
  std::vector<std::string> words = {program_.string()};
  words.insert(words.end(), task->words.begin(), task->words.end());
  words.insert(words.end(), task->extra.begin(), task->extra.end());
  std::string state = "failed", end;
  std::vector<std::string> lines;
  try {
    wait_for_earlier(*task);
    base::ChildProcess program(
        {.words = words, .folder = studies_.folder(), .output = task->output});
    std::optional<Clock::time_point> asked;
    std::optional<base::ProcessEnd> ended;
    std::unique_lock lock(mutex_);
    while (!(ended = program.end())) {
      const bool is_asked = is_ending_ || task->state == "stopping";
      if (is_asked && !asked) {
        program.ask_to_end();
        asked = Clock::now();
      }
      if (asked && Clock::now() > *asked + kPatience) program.kill();
      changed_.wait_for(lock, kLook);
    }
    if (ended->is_good()) {
      state = "done";
    } else if (ended->exit_code == kInterrupted) {
      state = "stopped";
    } else {
      end = ended->text();
    }
    lock.unlock();
    lines = said_in(task->output);
  } catch (const std::exception& error) {
    lines = {error.what()};
  }
  std::optional<Json> estimate;
  if (state == "done" && !task->estimate.empty()) {
    estimate = Json::parse(base::read_file_if_there(task->estimate).value_or(""), nullptr, false);
  }
  const std::lock_guard lock(mutex_);
  if (estimate && !estimate->is_discarded()) estimates_[task->study] = *estimate;
  task->state = state;
  task->end = end;
  task->lines = std::move(lines);
  task->seconds = std::chrono::duration<double>(Clock::now() - task->since).count();
}

Json Calibrations::task_json(const Task& task) const {
  const bool is_open =
      task.state == "waiting" || task.state == "running" || task.state == "stopping";
  const std::chrono::duration<double> since = Clock::now() - task.since;
  Json json{{"study", task.study},
            {"task", task.name},
            {"state", task.state},
            {"command", command_of(task.words)},
            {"seconds", is_open ? since.count() : task.seconds},
            {"end", task.end}};
  json["lines"] = is_open && task.state != "waiting" ? said_in(task.output) : task.lines;
  return json;
}

Json Calibrations::tasks() const {
  const std::lock_guard lock(mutex_);
  Json tasks = Json::array();
  for (const auto& task : open_) tasks.push_back(task_json(*task));
  for (const auto& task : ended_) tasks.push_back(task_json(*task));
  return {{"tasks", tasks}};
}

std::shared_ptr<Calibrations::Task> Calibrations::task_of(const std::string& study,
                                                          const std::string& name,
                                                          const std::string& amount) const {
  const fs::path folder = studies_.calibration_of(study);
  const std::string own = argument_of(study);
  auto task = std::make_shared<Task>();
  task->study = study;
  task->name = name;
  task->amount = amount;
  if (program_.empty()) throw base::InputError({.value = "this studio can start nothing"});
  if (!is_within(folder, studies_.folder())) {
    base::refuse(folder, "leads out of the folder", "move it away.");
  }
  if (name == "calibrate") {
    if (const auto minutes = calibrate::minutes_in(amount)) {
      task->words = {"calibrate", own, "--minutes", fmt::format("{:g}", *minutes)};
    } else {
      task->words = {"calibrate", own, "--budget",
                     calibrate::budget_named(amount.empty() ? "quick" : amount).name};
    }
    task->extra = {"--progress", (folder.filename() / kProgressFile).string()};
  } else if (name == "plan") {
    task->words = {"plan", own};
    if (!amount.empty()) {
      const auto minutes = calibrate::number_of(amount);
      if (!minutes) throw base::InputError({.where = "minutes", .value = "are no number"});
      task->words.insert(task->words.end(), {"--minutes", fmt::format("{:g}", *minutes)});
    }
    task->extra = {"--json", (folder.filename() / kPlanFile).string()};
  } else if (name == "estimate") {
    task->words = {"calibrate", own, "--dry-run"};
  } else {
    throw base::InputError({.where = base::printable(name), .value = "is no task"});
  }
  return task;
}

void Calibrations::open(const std::shared_ptr<Task>& task) {
  const int number = ++started_;
  task->output = temporary_ / fmt::format("{}.log", number);
  if (task->name == "estimate") {
    task->estimate = temporary_ / fmt::format("{}.json", number);
    task->extra = {"--json", task->estimate.string()};
  } else {
    // The program writes there before its own work begins.
    const fs::path folder = studies_.calibration_of(task->study);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) base::refuse(folder, "cannot be made (" + error.message() + ")", "free its name.");
  }
  open_.push_back(task);
}

void Calibrations::start(const std::string& study, const std::string& name,
                         const std::string& amount) {
  const auto task = task_of(study, name, amount);
  const std::lock_guard lock(mutex_);
  for (const auto& other : open_) {
    if (other->study != study || other->name != name) continue;
    throw base::InputError({.where = study, .value = "is in work or waits already"});
  }
  if (open_.size() >= kMostWaiting) {
    throw base::InputError({.where = study, .value = "cannot wait", .rule = "at most 50 do"});
  }
  open(task);
  write_down();
  changed_.notify_all();
}

void Calibrations::write_down() const {
  Json tasks = Json::array();
  for (const auto& task : open_) {
    if (task->is_given_up || task->name == "estimate") continue;
    tasks.push_back({{"study", task->study}, {"task", task->name}, {"amount", task->amount}});
  }
  try {
    base::write_whole_file(studies_.folder() / kTasksFile, text_of(tasks));
  } catch (const base::InputError&) {
    // On a full disk tasks still run; the next studio will not know of them.
  }
}

void Calibrations::take_up() {
  if (program_.empty()) return;
  const auto text = base::read_file_if_there(studies_.folder() / kTasksFile);
  const Json tasks = Json::parse(text.value_or(""), nullptr, false);
  if (!tasks.is_array()) return;
  for (const Json& one : tasks) {
    if (!one.is_object() || open_.size() >= kMostWaiting) continue;
    try {
      const auto task =
          task_of(one.value("study", ""), one.value("task", ""), one.value("amount", ""));
      task->is_taken_up = true;
      open(task);
    } catch (const base::InputError&) {
      // Its study no longer exists.
    } catch (const Json::exception&) {
      // Not written by a studio.
    }
  }
}

/// Waits for a program of a killed studio, which ends by itself after its current run.
void Calibrations::wait_for_earlier(const Task& task) {
  if (!task.is_taken_up) return;
  const fs::path lock_file = calibrate::lock_file_in(studies_.calibration_of(task.study));
  const Clock::time_point start = Clock::now();
  std::unique_lock lock(mutex_);
  while (!is_ending_ && !task.is_given_up && Clock::now() < start + kPatience &&
         base::is_locked_by_another(lock_file)) {
    changed_.wait_for(lock, kLook);
  }
}

void Calibrations::stop(const std::string& study, const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(
      open_, [&](const auto& task) { return task->study == study && task->name == name; });
  if (found == open_.end()) {
    throw base::InputError({.where = base::printable(study), .value = "is not in work"});
  }
  Task& task = **found;
  if (task.state == "waiting") {
    open_.erase(found);
  } else {
    task.state = "stopping";
    task.is_given_up = true;
  }
  write_down();
  changed_.notify_all();
}

Json Calibrations::exported(const std::string& study, const std::string& target,
                            bool takes_approximate) {
  const fs::path folder = studies_.calibration_of(study);
  std::vector<std::string> words = {"export", argument_of(folder.filename().string()), "--to",
                                    target};
  if (takes_approximate) words.emplace_back("--approximate");
  std::vector<std::string> all = {program_.string()};
  all.insert(all.end(), words.begin(), words.end());
  fs::path output;
  {
    const std::lock_guard lock(mutex_);
    output = temporary_ / fmt::format("{}.log", ++started_);
  }
  base::ChildProcess program({.words = all, .folder = studies_.folder(), .output = output});
  const Clock::time_point start = Clock::now();
  std::optional<base::ProcessEnd> ended;
  while (!(ended = program.end()) && Clock::now() < start + 3 * kPatience) {
    std::this_thread::sleep_for(kLook / 4);
  }
  return {{"command", command_of(words)},
          {"is_done", ended && ended->is_good()},
          {"lines", said_in(output)}};
}

}  // namespace repose::studio
