#include "calibrate/engine/make_runs.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/input_error.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr const char* kOutputFile = "output.txt";
constexpr const char* kEndedFile = "ended.json";
constexpr std::chrono::milliseconds kBetweenLooks{10};
constexpr std::chrono::seconds kToEnd{5};  // for a program that was asked to end
constexpr std::size_t kShownLines = 10;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Whether a run was prepared or has finished there.
bool is_of_run(const fs::path& folder) {
  return fs::exists(folder / kRunFile) || fs::exists(folder / kEndedFile);
}

/// Empties the folder, whatever an earlier attempt left there.
void empty_folder(const fs::path& folder) {
  if (base::is_in_use(folder / kOutputFile)) {
    base::refuse(folder, "the program of an earlier calibration is still running there",
                 "wait until it has ended, or end it.");
  }
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error) && !is_of_run(folder)) {
    base::refuse(folder, "has files that no engine's run left", "move them away.");
  }
  fs::remove_all(folder, error);
  if (!error) fs::create_directories(folder, error);
  if (error) {
    base::refuse(folder, fmt::format("cannot be written ({})", error.message()),
                 "choose another folder with --out, or free some space there.");
  }
}

/// A running program.
struct Running {
  std::size_t row = 0;
  fs::path folder;
  Clock::time_point start = Clock::now();
  std::unique_ptr<base::ChildProcess> process;
  std::optional<Clock::time_point> asked = {};  ///< to end

  /// The second call kills it.
  void stop() {
    if (!asked) {
      process->ask_to_end();
      asked = Clock::now();
    } else if (Clock::now() - *asked > kToEnd) {
      process->kill();
    }
  }
};

class Maker {
 public:
  Maker(EngineRuns& table, const Engine& engine, const MakeSettings& settings)
      : table_(table), engine_(engine), settings_(settings) {}

  std::optional<std::size_t> make(const std::vector<std::size_t>& rows) {
    const auto jobs = static_cast<std::size_t>(std::max(1, settings_.jobs));
    auto next = rows.begin();
    while (true) {
      const bool is_interrupted = settings_.is_interrupted != nullptr && *settings_.is_interrupted;
      while (!is_interrupted && next != rows.end() && running_.size() < jobs) start(*next++);
      for (Running& one : running_) look_at(one, is_interrupted);
      std::erase_if(running_, [](const Running& one) { return one.process == nullptr; });
      if (running_.empty()) {
        if (is_interrupted) return std::nullopt;
        if (next == rows.end()) return failed_;
        continue;
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
  }

 private:
  void start(std::size_t row) {
    Running run{.row = row, .folder = table_.folder_of(row), .process = nullptr};
    empty_folder(run.folder);
    engine_.prepare(table_.run(row), run.folder);
    base::ProcessStart program = engine_.start(run.folder);
    program.output = run.folder / kOutputFile;
    run.start = Clock::now();
    run.process = std::make_unique<base::ChildProcess>(program);
    running_.push_back(std::move(run));
  }

  void look_at(Running& run, bool is_interrupted) {
    const auto end = run.process->end();
    if (end && is_interrupted && run.asked) {
      run.process.reset();  // ended on request
    } else if (end) {
      finish(run, *end);
    } else if (is_interrupted || is_too_long(run)) {
      run.stop();
    }
  }

  bool is_too_long(const Running& run) const {
    return settings_.timeout_s && seconds_since(run.start) > *settings_.timeout_s;
  }

  void finish(Running& run, const base::ProcessEnd& end) {
    const double run_s = seconds_since(run.start);
    run.process.reset();
    EngineOutcome outcome;
    if (run.asked) {
      outcome.failure =
          fmt::format("took more than {:g} s, and was ended", settings_.timeout_s.value_or(run_s));
    } else if (!end.is_good()) {
      outcome.failure = end.text();
    } else if (!fs::is_directory(run.folder)) {
      outcome.failure = "it deleted its run's folder, with whatever it had left there";
    } else {
      outcome = engine_.read_back(run.folder);
    }
    std::error_code ignored;
    fs::create_directories(run.folder, ignored);  // the program may have deleted it
    const std::string failure = table_.keep(run.row, std::move(outcome));
    constexpr int kIndent = 2;
    const Json ended = {{"end", end.text()},
                        {"seconds", run_s},
                        {"failure", failure.empty() ? Json() : Json(failure)}};
    base::write_whole_file(run.folder / kEndedFile,
                           ended.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n');
    if (!failure.empty()) {
      ++failed_;
      if (settings_.note) settings_.note(failure_text(run, failure));
    }
    if (settings_.report) settings_.report();
  }

  std::string failure_text(const Running& run, const std::string& failure) const {
    const fs::path output = run.folder / kOutputFile;
    const std::vector<std::string> lines = base::last_lines(output, kShownLines);
    const std::string name = run.folder.filename().string();
    if (lines.empty()) {
      return fmt::format("{} failed: {}.{}", name, failure,
                         fs::exists(output) ? " It printed nothing." : "");
    }
    return fmt::format("{} failed: {}. The end of {}:\n  {}", name, failure, output.string(),
                       fmt::join(lines, "\n  "));
  }

  EngineRuns& table_;
  const Engine& engine_;
  const MakeSettings& settings_;
  std::vector<Running> running_;
  std::size_t failed_ = 0;
};

}  // namespace

std::optional<std::size_t> make_runs(EngineRuns& table, const Engine& engine,
                                     const std::vector<std::size_t>& rows,
                                     const MakeSettings& settings) {
  return Maker(table, engine, settings).make(rows);
}

std::optional<double> mean_run_s(const EngineRuns& table) {
  double sum = 0;
  int count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(table.folder(), error), end; !error && entry != end;
       entry.increment(error)) {
    const auto text = base::read_file_if_there(entry->path() / kEndedFile);
    if (!text) continue;
    const Json ended = Json::parse(*text, nullptr, false);
    if (!ended.is_object() || !ended.contains("seconds") || !ended["seconds"].is_number()) continue;
    if (!ended.contains("failure") || !ended["failure"].is_null()) continue;
    sum += ended["seconds"].get<double>();
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace repose::calibrate
