#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"

namespace repose::cli {

/// The name that stands for standard output.
inline constexpr std::string_view kStandardOutput = "-";

/// To be called before anything is opened or written: an output that fails is an error to be told
/// and never a signal, and a stream that was closed stays closed instead of becoming the next file.
void prepare_streams();

/// What a command gives: files that were asked for, and what people read on standard output.
class Outputs {
 public:
  /// `file` may be "-", or empty: not asked for.
  void add(const std::string& file, std::string text);

  /// For people, where no file takes standard output.
  void show(std::string text);

  /// All files but standard output, each whole or not at all. One that cannot be written does not
  /// keep the others from it.
  void write_files();

  /// The files, if they were not yet written, then standard output.
  /// @throws base::InputError  what could not be written, a line each.
  void write();

 private:
  struct Output {
    std::string file;
    std::string text;
  };
  std::vector<Output> files_;
  std::string shown_;
  std::string printed_;
  bool has_printed_ = false;
  std::vector<base::Fault> errors_;
};

/// Adds a line for each fault, with the options of the fields that `names` has.
void add_faults(const base::InputError& error, std::vector<std::string>& lines,
                base::FieldNames names = {});

/// To standard error, as it is. Where that is closed or full, nothing happens: what a command
/// measured does not depend on who listens.
void print_error_text(std::string_view text) noexcept;

/// Errors and notes: to standard error, each with the program's name before it.
void print_line(std::string_view line) noexcept;
void print_lines(const std::vector<std::string>& lines) noexcept;

}  // namespace repose::cli
