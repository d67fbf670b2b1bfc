#include "cli/common/output_places.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/whole_file.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "vision/picture/made_here.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) { return identity(a) == identity(b); }

}  // namespace

void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<fs::path>& inputs, std::vector<std::string>& errors) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [option, file] = places[i];
    if (file.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (places[j].file.empty() || !same_file(places[j].file, file)) continue;
      errors.push_back(fmt::format("{} and {} both write to {}. Fix: give each its own file.",
                                   places[j].option, option, file));
    }
    if (file == kStandardOutput) continue;
    if (has_picture_ending(file) && !vision::is_made_here(file)) {
      errors.push_back(
          fmt::format("{} {}: already exists, and is not a picture written by repose. Fix: choose "
                      "another name, or move it "
                      "away.",
                      option, file));
    }
    for (const fs::path& input : inputs) {
      if (input.empty() || !same_file(input, file)) continue;
      errors.push_back(fmt::format(
          "{} {}: would overwrite an input file. Fix: choose another name.", option, file));
    }
    try {
      base::check_can_write(file);
    } catch (const std::invalid_argument& error) {
      errors.push_back(fmt::format("{} {}", option, error.what()));
    }
  }
}

bool make_output_folder(const char* option, const fs::path& folder,
                        std::vector<std::string>& errors) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; error || !fs::is_directory(folder, ignored)) {
    errors.push_back(fmt::format(
        "{} {}: the folder cannot be created ({}). Fix: choose a writable place.", option,
        folder.string(), error ? error.message() : "there is a file of that name"));
    return false;
  }
  try {
    base::check_can_write(folder / "file");
    return true;
  } catch (const std::invalid_argument& unwritable) {
    errors.push_back(fmt::format("{} {}", option, unwritable.what()));
    return false;
  }
}

}  // namespace repose::cli
