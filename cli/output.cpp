#include "cli/output.h"

#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include "io/whole_file.h"

namespace repose::cli {

void write_output(const std::string& file, std::string_view text) {
  if (file != kStandardOutput) {
    io::write_whole_file(file, text);
    return;
  }
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!is_written || std::fflush(stdout) != 0) {
    throw std::invalid_argument(
        "standard output: cannot be written. Fix: look whether the disk is full or the program "
        "that reads it has ended.");
  }
}

void print_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) fmt::print(stderr, "repose: {}\n", line);
}

}  // namespace repose::cli
