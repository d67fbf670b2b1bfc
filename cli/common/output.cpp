#include "cli/common/output.h"

#include <cstdio>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "base/whole_file.h"

namespace repose::cli {

void write_output(const std::string& file, std::string_view text) {
  if (file != kStandardOutput) {
    base::write_whole_file(file, text);
    return;
  }
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!is_written || std::fflush(stdout) != 0) {
    throw std::invalid_argument(
        "standard output: cannot be written. Fix: look whether the disk is full or the program "
        "that reads it has ended.");
  }
}

void add_lines(const std::string& text, std::vector<std::string>& lines) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
}

void print_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) fmt::print(stderr, "repose: {}\n", line);
}

}  // namespace repose::cli
