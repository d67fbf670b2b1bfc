#include "cli/common/output_places.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/whole_file.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "vision/film/film_angle.h"
#include "vision/picture/made_here.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// What else such a name may be of.
constexpr std::array<std::string_view, 14> kOtherEndings{".json", ".csv", ".html", ".htm", ".toml",
                                                         ".pdf",  ".stl", ".glb",  ".obj", ".ply",
                                                         ".vtp",  ".vtk", ".xlsx", ".ods"};

std::string small_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

/// Of the name alone, so that no photograph is measured later that is a page.
std::string error_of_name(const OutputPlace& place) {
  const std::string ending = small_ending(place.file);
  if (place.ending.empty() || ending == place.ending ||
      (ending == ".htm" && place.ending == ".html")) {
    return {};
  }
  const bool is_other =
      has_picture_ending(place.file) || vision::has_film_ending(place.file) ||
      std::find(kOtherEndings.begin(), kOtherEndings.end(), ending) != kOtherEndings.end();
  if (!is_other) return {};
  return fmt::format("names of {} files are for another kind of file. Fix: a name that ends in {}.",
                     ending, place.ending);
}

/// A JSON file has the names of a CSV's columns too: the header alone counts.
bool is_of_its_kind(std::string_view text, const OutputPlace& place) {
  if (place.ending != ".csv") return text.find(place.mark) != std::string_view::npos;
  const std::string_view header = text.substr(0, text.find('\n') + 1);
  return !header.starts_with('{') && !header.starts_with('[') &&
         header.find(place.mark) != std::string_view::npos;
}

/// Of a file that is there already.
std::string error_of_earlier(const OutputPlace& place) {
  std::error_code ignored;
  if (!fs::is_regular_file(place.file, ignored) || fs::file_size(place.file, ignored) == 0) {
    return {};
  }
  constexpr const char* kFix = "Fix: choose another name, or move it away.";
  if (has_picture_ending(place.file)) {
    return vision::is_made_here(place.file)
               ? ""
               : fmt::format("already exists, and is not a picture written by repose. {}", kFix);
  }
  if (place.mark.empty()) return {};
  const std::string other =
      fmt::format("already exists, and is not what this option writes. {}", kFix);
  try {
    return is_of_its_kind(base::read_whole_file(place.file), place) ? "" : other;
  } catch (const base::InputError&) {
    return other;  // what cannot be read is not ours either
  }
}

bool same_file(const fs::path& a, const fs::path& b) { return identity(a) == identity(b); }

}  // namespace

OutputPlace json_place(const std::string& file, std::string_view key, const char* option) {
  return {.option = option, .file = file, .ending = ".json", .mark = key};
}

OutputPlace csv_place(const char* option, const std::string& file, std::string_view column) {
  return {.option = option, .file = file, .ending = ".csv", .mark = column};
}

OutputPlace page_place(const char* option, const std::string& file) {
  constexpr std::string_view kGenerator = R"(<meta name="generator" content="repose)";
  return {.option = option, .file = file, .ending = ".html", .mark = kGenerator};
}

void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<fs::path>& inputs, std::vector<std::string>& errors) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [option, file, ending, mark] = places[i];
    if (file.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (places[j].file.empty() || !same_file(places[j].file, file)) continue;
      errors.push_back(fmt::format("{} and {} both write to {}. Fix: give each its own file.",
                                   places[j].option, option, file));
    }
    if (file == kStandardOutput) continue;
    const bool is_input = std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
      return !input.empty() && same_file(input, file);
    });
    std::string error = is_input ? "would overwrite an input file. Fix: choose another name."
                                 : error_of_name(places[i]);
    if (error.empty()) error = error_of_earlier(places[i]);
    if (!error.empty()) errors.push_back(fmt::format("{} {}: {}", option, file, error));
    try {
      base::check_can_write(file);
    } catch (const base::InputError& refused) {
      errors.push_back(fmt::format("{} {}", option, refused.what()));
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
  } catch (const base::InputError& unwritable) {
    errors.push_back(fmt::format("{} {}", option, unwritable.what()));
    return false;
  }
}

}  // namespace repose::cli
