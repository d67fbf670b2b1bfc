#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/particles/positions_angle.h"
#include "cli/common/command.h"

/// Options of all commands that take files with the places of particles.

namespace repose::cli {

/// As typed.
struct PositionArguments {
  std::string unit;
  std::string up;
  std::string plate_height;
  std::string step;
  std::string particle_mm;

  /// The first that is given; empty: none is.
  const char* given() const;
  /// The same of those that say something of particles alone.
  const char* of_particles() const;
};

/// By the fields that reading them finds fault with.
inline constexpr std::array<base::FieldName, 5> kPositionFields{
    {{"particles' unit", "--unit"},
     {"direction that is up", "--up"},
     {"plate's height", "--plate-height"},
     {"time step", "--step"},
     {"particles' diameter", "--particle-mm"}}};

/// They lead to `arguments`.
std::vector<CommandOption> position_options(PositionArguments& arguments);

/// What they do, for a command's help.
extern const char* const kPositionNotes;

calibrate::PositionsOptions read_position_options(const PositionArguments& arguments,
                                                  std::vector<std::string>& errors);

/// Names of pictures, films, scans and folders, in which those of folders that hold none of these,
/// but files of particles, have become the files' names.
std::vector<std::string> with_positions_of_folders(const std::vector<std::string>& names);

}  // namespace repose::cli
