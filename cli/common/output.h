#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"

namespace repose::cli {

enum class ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  nothing_measurable = 3,
  interrupted = 130,
};

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

/// A file, or standard output, that an option names; empty when it is not given.
struct OutputPlace {
  const char* option = "";
  std::string file;
  /// Of the names of such files: ".json". Empty: the command checks it.
  std::string_view ending = {};
  /// Text that every such file of repose has: another one of that name is somebody's. Empty: it is
  /// in a folder that is checked as a whole.
  std::string_view mark = {};
};

/// In every 3-D model that is written, by the library that writes them: [Aa]ssimp.
inline constexpr std::string_view kMeshMark = "ssimp";

/// @param key  in quotation marks, which each such JSON has
OutputPlace json_place(const std::string& file, std::string_view key,
                       const char* option = "--json");
OutputPlace csv_place(const char* option, const std::string& file, std::string_view column);
OutputPlace page_place(const char* option, const std::string& file);

/// Adds an error for two outputs in one place; an input, a file of another kind or one that repose
/// did not make, which would be overwritten; and a place that cannot be written. Proved by
/// OutputsOf.* in tests/cli/outputs_test.cpp.
void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<std::filesystem::path>& inputs,
                         std::vector<std::string>& errors);

/// Makes a folder that an option names, for files to be written into; adds an error when it cannot.
/// @returns whether it is there and can be written to.
bool make_output_folder(const char* option, const std::filesystem::path& folder,
                        std::vector<std::string>& errors);

}  // namespace repose::cli
