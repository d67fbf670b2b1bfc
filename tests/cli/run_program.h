#pragma once

#include <string>
#include <vector>

#include <unistd.h>

#include "tests/cli/program_server.h"
#include "tests/support/places.h"

namespace repose::testing {

/// Starts the built program in a folder without waiting for it.
inline pid_t start_repose(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), program());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder.path().c_str()) == 0) ::execv(pointers.front(), pointers.data());
    ::_exit(127);
  }
  return child;
}

/// Runs the program in `folder` and waits for it.
inline Finished run_repose(const TemporaryFolder& folder,
                           const std::vector<std::string>& arguments) {
  return run_forked(folder, arguments);
}

}  // namespace repose::testing
