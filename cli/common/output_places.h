#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace repose::cli {

/// A file, or standard output, that an option names; empty when it is not given.
struct OutputPlace {
  const char* option = "";
  std::string file;
};

/// Adds an error for two outputs in one place, an input or somebody's picture that would be
/// overwritten, and a place that cannot be written.
void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<std::filesystem::path>& inputs,
                         std::vector<std::string>& errors);

/// Makes a folder that an option names, for files to be written into; adds an error when it cannot.
/// @returns whether it is there and can be written to.
bool make_output_folder(const char* option, const std::filesystem::path& folder,
                        std::vector<std::string>& errors);

}  // namespace repose::cli
