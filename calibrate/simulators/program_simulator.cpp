#include "calibrate/simulators/program_simulator.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/input_error.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenLooks{10};
constexpr std::size_t kShownLines = 10;

fs::path temporary_folder() {
  std::string name = (fs::temp_directory_path() / "repose-run-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    base::refuse(name,
                 fmt::format("cannot be created ({})", std::generic_category().message(errno)),
                 "set TMPDIR to a folder that can be written.");
  }
  return name;
}

[[noreturn]] void fail(const fs::path& folder, const std::string& program, const std::string& why) {
  const fs::path output = folder / ProgramSimulator::kOutputFile;
  const std::vector<std::string> lines = base::last_lines(output, kShownLines);
  throw base::InputError(
      {.where = folder.string(),
       .value = lines.empty()
                    ? fmt::format("{} {}; it printed nothing", program, why)
                    : fmt::format("{} {}. The end of {}:\n  {}\n", program, why,
                                  ProgramSimulator::kOutputFile, fmt::join(lines, "\n  ")),
       .fix = "start it again in that folder to look into it."});
}

base::ProcessEnd wait_for(base::ChildProcess& program, const ProgramWatch& watch,
                          const fs::path& folder) {
  const Clock::time_point begun = Clock::now();
  for (;;) {
    if (const auto end = program.end()) return *end;
    if (watch.goes_on && !watch.goes_on()) throw dem::Interrupted("interrupted");
    const std::chrono::duration<double> spent = Clock::now() - begun;
    if (watch.timeout_s && spent.count() > *watch.timeout_s) {
      fail(folder, watch.title,
           fmt::format("took more than timeout_s = {:g} s, and was ended", *watch.timeout_s));
    }
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

}  // namespace

WorkFolder::WorkFolder(const fs::path& asked) : path_(asked.empty() ? temporary_folder() : asked) {
  if (base::is_in_use(path_ / ProgramSimulator::kOutputFile)) {
    base::refuse(path_, "the program of an earlier run is still running there",
                 "wait until it has ended, or end it.");
  }
  std::error_code error;
  fs::remove_all(path_, error);
  if (!error) fs::create_directories(path_, error);
  if (error) {
    base::refuse(path_, fmt::format("cannot be written ({})", error.message()),
                 "choose another folder, or free some space there.");
  }
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  if (!is_kept_) fs::remove_all(path_, ignored);
}

void run_to_end(base::ProcessStart program, WorkFolder& folder, const ProgramWatch& watch) {
  program.folder = folder.path();
  program.output = folder.path() / ProgramSimulator::kOutputFile;
  try {
    base::ChildProcess process(program);
    const base::ProcessEnd end = wait_for(process, watch, folder.path());
    if (!end.is_good()) fail(folder.path(), watch.title, "failed: " + end.text());
  } catch (const base::InputError&) {
    folder.keep();
    throw;
  } catch (const std::system_error& error) {
    throw base::InputError({.where = program.words.front(),
                            .value = fmt::format("cannot be started ({})", error.what()),
                            .fix = "see that it is installed and in PATH."});
  }
}

dem::Repeat ProgramSimulator::run(const RunCall& call) const {
  base::Faults faults;
  faults.add_all(refusals(call.spec));
  faults.throw_if_any();
  WorkFolder folder(call.folder);
  prepare(call.spec, call.seed, folder.path());
  run_to_end(start(call.spec, call.seed, folder.path()), folder,
             {.title = title(),
              .timeout_s = timeout_s_,
              // Its progress is unknown.
              .goes_on = [&call] { return !call.goes_on || call.goes_on(0); }});
  try {
    dem::Repeat repeat = read_back(call.spec, call.seed, folder.path());
    repeat.seed = call.seed;
    return repeat;
  } catch (const base::InputError&) {
    folder.keep();
    throw;
  }
}

std::optional<std::string> printed_by(const std::vector<std::string>& words) {
  constexpr std::chrono::seconds kLongest{60};
  const Clock::time_point begun = Clock::now();
  const WorkFolder folder;
  const fs::path output = folder.path() / ProgramSimulator::kOutputFile;
  try {
    base::ChildProcess program({.words = words, .folder = folder.path(), .output = output});
    for (;;) {
      const auto end = program.end();
      if (end && !end->is_good()) return std::nullopt;
      if (Clock::now() - begun > kLongest) return std::nullopt;
      if (end) return base::read_whole_file(output);
      std::this_thread::sleep_for(kBetweenLooks);
    }
  } catch (const std::system_error&) {
    return std::nullopt;
  }
}

}  // namespace repose::calibrate
