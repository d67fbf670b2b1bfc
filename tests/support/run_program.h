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
  int exit_code = -1;  ///< 127 when the program could not be started
  std::string out;
  std::string err;
  double elapsed_s = 0;
  double cpu_s = 0;
};

/// Starts a program in `folder`, as a user would, and waits for it. Its output goes to files, so it
/// is no terminal to it. A name without a slash is looked for in PATH.
inline Finished run_program(std::string program, const TemporaryFolder& folder,
                            const std::vector<std::string>& arguments) {
  const TemporaryFolder logs;
  const std::string out = logs.path() / "out", err = logs.path() / "err";
  std::vector<char*> words = {program.data()};
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);

  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr int kReadableByOwner = 0600;
    const bool is_set_up =
        ::chdir(folder.path().c_str()) == 0 &&
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 1) == 1 &&
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 2) == 2;
    if (is_set_up) ::execvp(program.c_str(), words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage used = {};
  ::wait4(child, &status, 0, &used);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = text_of(out),
          .err = text_of(err),
          .elapsed_s = elapsed.count(),
          .cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime)};
}

}  // namespace repose::testing
