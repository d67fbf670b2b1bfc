#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace repose::testing {

struct Finished {
  int exit_code = -1;  ///< 127 if the program could not be started
  std::string out;
  std::string err;
  double elapsed_s = 0;
  double cpu_s = 0;
};

/// A process's output files: it must not see a terminal.
struct Logs {
  TemporaryFolder folder;
  std::string out = folder.path() / "out";
  std::string err = folder.path() / "err";
};

/// Redirects the current process's output there and changes to `folder`. @return whether it worked
inline bool enter(const std::string& folder, const std::string& out, const std::string& err) {
  constexpr int kReadableByOwner = 0600;
  return ::chdir(folder.c_str()) == 0 &&
         ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 1) == 1 &&
         ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 2) == 2;
}

/// How a process ended.
struct Ended {
  int status = 0;
  rusage used = {};
};

inline Ended wait_for(pid_t child) {
  Ended ended;
  ::wait4(child, &ended.status, 0, &ended.used);
  return ended;
}

using Clock = std::chrono::steady_clock;

inline Finished finished(const Ended& ended, const Logs& logs, Clock::time_point start) {
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {.exit_code = WIFEXITED(ended.status) ? WEXITSTATUS(ended.status) : -1,
          .out = text_of(logs.out),
          .err = text_of(logs.err),
          .elapsed_s = elapsed.count(),
          .cpu_s = seconds(ended.used.ru_utime) + seconds(ended.used.ru_stime)};
}

/// Starts a program in `folder`, as a user would, and waits for it. A name without a slash is
/// looked for in PATH.
inline Finished run_program(std::string program, const TemporaryFolder& folder,
                            const std::vector<std::string>& arguments) {
  const Logs logs;
  std::vector<char*> words = {program.data()};
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);

  const Clock::time_point start = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    if (enter(folder.path(), logs.out, logs.err)) ::execvp(program.c_str(), words.data());
    ::_exit(127);
  }
  return finished(wait_for(child), logs, start);
}

}  // namespace repose::testing
