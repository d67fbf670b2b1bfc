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

/// Must be called before anything is opened or written: a failing output is then reported as an
/// error and never raises a signal, and a closed stream stays closed instead of becoming the next
/// opened file.
void prepare_streams();

/// A command's outputs: requested files, and text for people on standard output.
class Outputs {
 public:
  /// `file` may be "-", or empty: not requested.
  void add(const std::string& file, std::string text);

  /// Text for people, shown if no file goes to standard output.
  void show(std::string text);

  /// Writes all files except standard output, each atomically. An error in one does not prevent the
  /// others.
  void write_files();

  /// Writes the files, unless already written, then standard output.
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

/// Adds a line for each error, with the options of the fields in `names`.
void add_faults(const base::InputError& error, std::vector<std::string>& lines,
                base::FieldNames names = {});

/// Writes to standard error unchanged. Failures (closed or full) are ignored: a command's results
/// must not depend on who listens.
void print_error_text(std::string_view text) noexcept;

/// Prints errors and notes to standard error, each prefixed with the program's name.
void print_line(std::string_view line) noexcept;
void print_lines(const std::vector<std::string>& lines) noexcept;

/// A file, or standard output, named by an option; empty: not given.
struct OutputPlace {
  const char* option = "";
  std::string file;
  /// Extension of such files: ".json". Empty: checked by the command.
  std::string_view ending = {};
  /// Text contained in every such file of repose; a file of that name without it is the user's.
  /// Empty: the file is in a folder that is checked as a whole.
  std::string_view mark = {};
};

/// Contained in every 3-D model written here, from the library that writes them: [Aa]ssimp.
inline constexpr std::string_view kMeshMark = "ssimp";

/// @param key  in quotation marks, contained in each such JSON
OutputPlace json_place(const std::string& file, std::string_view key,
                       const char* option = "--json");
OutputPlace csv_place(const char* option, const std::string& file, std::string_view column);
OutputPlace page_place(const char* option, const std::string& file);

/// Adds an error for two outputs to the same file; an output that would overwrite an input, a file
/// of another kind or one that repose did not make; and a file that cannot be written. Proved by
/// OutputsOf.* in tests/cli/outputs_test.cpp.
void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<std::filesystem::path>& inputs,
                         std::vector<std::string>& errors);

/// Creates an output folder named by an option; adds an error on failure.
/// @returns whether it exists and is writable.
bool make_output_folder(const char* option, const std::filesystem::path& folder,
                        std::vector<std::string>& errors);

}  // namespace repose::cli
