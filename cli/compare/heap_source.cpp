#include "cli/compare/heap_source.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "calibrate/study/study_record.h"
#include "cli/common/picture_list.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// Those of a folder that `is_wanted` takes, by name; none when it cannot be read.
template <typename Wanted>
std::vector<fs::path> files_of(const fs::path& folder, const Wanted& is_wanted) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.') && is_wanted(entry->path())) found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool is_picture(const fs::path& file) {
  return has_picture_ending(file) && !is_overlay_of_state(file);
}

bool is_heap_state(const fs::path& file) {
  return has_state_ending(file) && file.filename().string().starts_with("heap");
}

HeapSource folder_source(const std::string& name, std::vector<std::string>& errors) {
  HeapSource source{.name = name, .pictures = {}, .states = {}, .is_file = false};
  source.pictures = files_of(name, is_picture);
  if (!source.pictures.empty()) return source;
  source.states = files_of(fs::path(name) / calibrate::kHeapsFolder, is_heap_state);
  if (source.states.empty()) source.states = files_of(name, is_heap_state);
  if (source.states.empty()) {
    errors.push_back(fmt::format(
        "{}: no pictures and no simulated heaps in this folder. Fix: name a folder with "
        ".jpg, .png, .tif, .bmp or .webp files in it, or one that repose simulate heap "
        "--out or repose calibrate --out has written.",
        name));
  }
  return source;
}

}  // namespace

bool has_state_ending(const fs::path& file) { return file.extension() == ".vtp"; }

std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors) {
  std::array<HeapSource, 2> sources;
  for (std::size_t i = 0; i < sources.size() && i < names.size(); ++i) {
    std::error_code error;
    if (fs::is_directory(names[i], error)) {
      sources[i] = folder_source(names[i], errors);
    } else if (has_state_ending(names[i])) {
      sources[i] = {.name = names[i], .pictures = {}, .states = {names[i]}};
    } else {
      sources[i] = {.name = names[i], .pictures = {names[i]}, .states = {}};
    }
  }
  return sources;
}

}  // namespace repose::cli
