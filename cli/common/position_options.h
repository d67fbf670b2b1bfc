#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/particles/positions_angle.h"
#include "cli/common/command.h"

/// Options shared by all commands that take files of particle positions.

namespace repose::cli {

/// The options as typed.
struct PositionArguments {
  std::string unit;
  std::string up;
  std::string plate_height;
  std::string step;
  std::string particle_mm;

  /// Name of the first option given; empty: none.
  const char* given() const;
  /// The same among options that apply only to particles.
  const char* of_particles() const;
};

/// Maps the fields named in errors when reading such files to options.
inline constexpr std::array<base::FieldName, 5> kPositionFields{
    {{"particles' unit", "--unit"},
     {"direction that is up", "--up"},
     {"plate's height", "--plate-height"},
     {"time step", "--step"},
     {"particles' diameter", "--particle-mm"}}};

/// The options, stored in `arguments`.
std::vector<CommandOption> position_options(PositionArguments& arguments);

/// Their description for a command's help.
extern const char* const kPositionNotes;

calibrate::PositionsOptions read_position_options(const PositionArguments& arguments,
                                                  std::vector<std::string>& errors);

/// Names of pictures, films, scans and folders, with each folder that holds none of these but
/// particle files replaced by the names of these files.
std::vector<std::string> with_positions_of_folders(const std::vector<std::string>& names);

}  // namespace repose::cli
