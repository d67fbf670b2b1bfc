#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "tests/cli/run_program.h"

namespace repose::testing {

using nlohmann::json;
using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Runs one command, in a folder of its own.
class CommandTest : public ::testing::Test {
 protected:
  explicit CommandTest(Words command) : command_(std::move(command)) {}

  Words with_command(Words words) const {
    words.insert(words.begin(), command_.begin(), command_.end());
    return words;
  }
  Finished run(const Words& words) const { return run_repose(folder_, with_command(words)); }

  /// Its JSON output.
  json result(Words words) const {
    words.insert(words.end(), {"--json", "-"});
    const Finished done = run(words);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return json::parse(done.out);
  }

  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::string text(const std::string& name) const { return text_of(path(name)); }

  TemporaryFolder folder_;

 private:
  Words command_;
};

/// A result of repose simulate without its timings.
inline json without_times(json result) {
  for (json& repeat : result["repeats"]) {
    for (const char* key : {"wall_s", "clump_steps_per_s"}) repeat.erase(key);
  }
  return result;
}

/// Length of the longest line, in characters.
inline std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    longest = std::max(longest, base::letters(line));
  }
  return longest;
}

}  // namespace repose::testing
