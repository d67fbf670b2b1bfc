#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace repose::cli {

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
