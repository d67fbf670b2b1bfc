#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/measured/measured_file.h"
#include "cli/common/command.h"
#include "cli/common/picture_options.h"
#include "cli/common/position_options.h"

namespace repose::cli {

/// Maps the fields named in a measurement's errors and advice to options.
inline constexpr std::array<base::FieldName, 14> kMeasureFields{
    {{"excluded box", "--exclude X,Y,W,H"},
     {"camera pitch", "--pitch-deg"},
     {"heap box", "--heap"},
     {"ground points", "--ground"},
     {"point to keep", "--keep"},
     {"point to drop", "--drop"},
     {"camera file", "--camera-file"},
     {"unit", "--unit mm"},
     {"ground plane", "--ground-plane"},
     kPositionFields[0],
     kPositionFields[1],
     kPositionFields[2],
     kPositionFields[3],
     kPositionFields[4]}};

/// The arguments of `repose measure`, as typed.
struct MeasureArguments {
  std::vector<std::string> pictures;  ///< also films and particles: files and folders
  std::string method;
  std::string window;
  std::string definition;
  std::vector<std::string> exclude;
  std::string heap;
  std::string rotate;
  std::string half;
  std::string ground;
  std::vector<std::string> keep;
  std::vector<std::string> drop;
  std::string mask_file;
  std::string pitch_deg;
  ScaleArguments scale;
  std::string ground_plane;
  PositionArguments positions;
  std::string every;
  std::string fps;
  std::string threads;
  std::string overlay_folder;
  std::string json_file;
  std::string csv_file;
  std::string summary_file;
  std::string report_file;
  bool shows_definitions = false;
  bool groups_by_name = false;
  bool saves_hints = false;
};

/// A `repose measure` that can be carried out.
struct MeasurePlan : calibrate::FileMeasuring {
  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user
};

/// Reads and checks all arguments, and whether the output can be written, so that no work is lost.
/// Reports all errors at once.
MeasurePlan plan_measure(const MeasureArguments& arguments);

Command measure_command();

}  // namespace repose::cli
