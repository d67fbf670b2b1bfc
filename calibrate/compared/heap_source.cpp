#include "calibrate/compared/heap_source.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "calibrate/measured/measured_file.h"
#include "calibrate/study/study_record.h"
#include "dem/experiment/experiment_table.h"
#include "vision/files/file_list.h"
#include "vision/scan/scan_file.h"

namespace repose::calibrate {

namespace {

namespace fs = std::filesystem;

/// Files of a folder accepted by `is_wanted`, sorted by name; empty if it cannot be read.
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
  return vision::has_picture_ending(file) && !vision::is_overlay_of_state(file);
}

bool is_heap_state(const fs::path& file) {
  return file.extension() == ".vtp" &&
         file.filename().string().starts_with(dem::pictured_experiment().name);
}

HeapSource folder_source(const std::string& name, std::vector<std::string>& errors) {
  using Kind = HeapSource::Kind;
  HeapSource source{.name = name, .kind = Kind::pictures, .files = {}, .is_file = false};
  source.files = files_of(name, is_picture);
  if (!source.files.empty()) return source;
  source.kind = Kind::scans;
  source.files = files_of(name, vision::has_scan_ending);
  if (!source.files.empty()) return source;
  source.kind = Kind::simulated;
  source.files = files_of(fs::path(name) / kHeapsFolder, is_heap_state);
  if (source.files.empty()) source.files = files_of(name, is_heap_state);
  if (source.files.empty()) source.files = files_of(name, is_positions_file);
  if (source.files.empty()) {
    errors.push_back(fmt::format(
        "{}: no pictures, no scans and no simulated heaps in this folder (subfolders are not "
        "searched). Fix: name a folder with .jpg, .heic, .png, .tif, .bmp or .webp files in it, "
        "with .ply, .obj, .stl or .glb, with files of particles (.csv, .vtk, .vtu, dumps), or one "
        "that repose simulate heap --out or repose calibrate --out has written.",
        name));
  }
  return source;
}

}  // namespace

HeapSource::Kind kind_of_heap(const fs::path& file) {
  if (vision::has_scan_ending(file)) return HeapSource::Kind::scans;
  return is_positions_file(file) ? HeapSource::Kind::simulated : HeapSource::Kind::pictures;
}

std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors) {
  std::array<HeapSource, 2> sources;
  for (std::size_t i = 0; i < sources.size() && i < names.size(); ++i) {
    std::error_code error;
    if (fs::is_directory(names[i], error)) {
      sources[i] = folder_source(names[i], errors);
    } else {
      sources[i] = {.name = names[i], .kind = kind_of_heap(names[i]), .files = {names[i]}};
    }
  }
  return sources;
}

const char* name_of(HeapSource::Kind kind) {
  if (kind == HeapSource::Kind::pictures) return "pictures";
  return kind == HeapSource::Kind::scans ? "scanned" : "simulated";
}

std::string title_of(const HeapSource& source) {
  const std::filesystem::path path(source.name);
  const std::filesystem::path name =
      path.has_filename() ? path.filename() : path.parent_path().filename();
  return fmt::format("{} ({})", name.string(), name_of(source.kind));
}

}  // namespace repose::calibrate
