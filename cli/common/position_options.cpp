#include "cli/common/position_options.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "calibrate/measured/measured_file.h"
#include "cli/common/option_value.h"
#include "vision/files/file_list.h"

namespace repose::cli {

const char* PositionArguments::given() const { return unit.empty() ? of_particles() : "--unit"; }

const char* PositionArguments::of_particles() const {
  for (const auto& [name, text] :
       {std::pair{"--up", &up}, std::pair{"--plate-height", &plate_height},
        std::pair{"--step", &step}, std::pair{"--particle-mm", &particle_mm}}) {
    if (!text->empty()) return name;
  }
  return "";
}

std::vector<CommandOption> position_options(PositionArguments& arguments) {
  return {{"--unit", "m|cm|mm|um|in", "Scans and particles: unit, if the file has none",
           &arguments.unit},
          {"--up", "x|y|z|-x|-y|-z", "Particles: direction that is up (z)", &arguments.up},
          {"--plate-height", "NUMBER", "Particles: the plate, on that axis (found)",
           &arguments.plate_height},
          {"--step", "NUMBER", "Particles: time step (the latest)", &arguments.step},
          {"--particle-mm", "MM", "Particles: diameter, where the file has none",
           &arguments.particle_mm}};
}

const char* const kPositionNotes = R"(
Particles: a table with a header (CSV, tab-separated or in columns) with x, y, z
and radius or diameter, and clump where several spheres make up a grain; a text
dump of LIGGGHTS or LAMMPS; VTK (.vtk, .vtu, .vtp); results that EDEM exports as
text. A unit in a header counts: x [mm]. The plate is found under the heap, or
given with --plate-height in the file's unit, as with --up=-z.
)";

calibrate::PositionsOptions read_position_options(const PositionArguments& arguments,
                                                  std::vector<std::string>& errors) {
  constexpr double kFarthest = 1e12, kLargest_mm = 1e4, kSmallest_mm = 1e-4;
  calibrate::PositionsOptions options;
  if (read_choice<double>({"--unit", arguments.unit, errors},
                          {{"m", 1}, {"cm", 1}, {"mm", 1}, {"um", 1}, {"in", 1}})) {
    options.reading.unit = arguments.unit;
  }
  Choices<calibrate::Up> directions;
  for (const auto& [name, up] : calibrate::kUpNames) directions.emplace_back(name, up);
  options.placement.up = read_choice<calibrate::Up>({"--up", arguments.up, errors}, directions)
                             .value_or(options.placement.up);
  options.placement.plate = read_number_within({"--plate-height", arguments.plate_height, errors},
                                               -kFarthest, kFarthest, "--plate-height 0");
  options.reading.step = read_number_within({"--step", arguments.step, errors}, 0, 1e18,
                                            "a time step that the file has");
  options.reading.diameter_mm = read_number_within({"--particle-mm", arguments.particle_mm, errors},
                                                   kSmallest_mm, kLargest_mm, "--particle-mm 4");
  return options;
}

namespace {

/// Those of a folder, by name, without subfolders; empty if it cannot be read.
std::vector<std::filesystem::path> positions_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path& file = entry->path();
    if (!file.filename().string().starts_with('.') && calibrate::is_positions_file(file)) {
      found.push_back(file);
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::vector<std::string> with_positions_of_folders(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    if (std::filesystem::is_directory(name, ignored) &&
        vision::list_heap_files({name}).files.empty()) {
      files = positions_files_in(name);
    }
    if (files.empty()) all.push_back(name);
    for (const std::filesystem::path& file : files) all.push_back(file.string());
  }
  return all;
}

}  // namespace repose::cli
