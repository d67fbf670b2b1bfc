#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace repose::cli {

/// The name that stands for standard output.
inline constexpr std::string_view kStandardOutput = "-";

/// Writes to a file, whole or not at all, or to standard output.
/// @throws std::invalid_argument  when it cannot be written.
void write_output(const std::string& file, std::string_view text);

/// Adds each line of a text, such as an exception's that tells several errors.
void add_lines(const std::string& text, std::vector<std::string>& lines);

/// Errors and notes: to standard error, each with the program's name before it.
void print_lines(const std::vector<std::string>& lines);

}  // namespace repose::cli
