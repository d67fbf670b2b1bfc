#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace repose::testing {

struct Finished {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Starts the built program in a folder and does not wait for it.
inline pid_t start_repose(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), REPOSE_PROGRAM);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder.path().c_str()) == 0) ::execv(REPOSE_PROGRAM, pointers.data());
    ::_exit(127);
  }
  return child;
}

/// Starts the built program in `folder`, as a user would, and waits for it. Its output goes to
/// files, so it is no terminal to it.
inline Finished run_repose(const TemporaryFolder& folder,
                           const std::vector<std::string>& arguments) {
  const TemporaryFolder logs;
  const std::string out = logs.path() / "out", err = logs.path() / "err";
  std::string program = REPOSE_PROGRAM;
  std::vector<char*> words = {program.data()};
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);

  const pid_t child = ::fork();
  if (child == 0) {
    constexpr int kReadableByOwner = 0600;
    const bool is_set_up =
        ::chdir(folder.path().c_str()) == 0 &&
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 1) == 1 &&
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, kReadableByOwner), 2) == 2;
    if (is_set_up) ::execv(program.c_str(), words.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = text_of(out),
          .err = text_of(err)};
}

}  // namespace repose::testing
