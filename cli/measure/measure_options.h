#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/command.h"
#include "cli/common/picture_options.h"
#include "cli/common/position_options.h"
#include "vision/camera/sized_heap.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scanned_heap.h"

namespace repose::cli {

/// Its options by the fields that a measurement finds fault with, or advises to give.
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

/// What `repose measure` is asked to do, as typed.
struct MeasureArguments {
  std::vector<std::string> pictures;  ///< and films and particles: files and folders
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
struct MeasurePlan {
  std::vector<std::filesystem::path> pictures;  ///< and films, and files of particles
  std::vector<std::filesystem::path> overlays;  ///< one a picture, or none
  bool keeps_overlays = false;                  ///< in memory, for a report
  vision::MeasureOptions options;
  std::optional<double> frames_per_s;  ///< of folders, each a film's frames
  vision::ScaleOptions scale;
  vision::ScanOptions scan;
  calibrate::PositionsOptions positions;  ///< of files of particles
  std::optional<double> every_s;          ///< also frames of each film, so far apart
  bool saves_hints = false;
  int threads = 1;

  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user to know
};

/// Reads and checks all that was typed, also whether the output can be written, so that no work is
/// lost. All errors at once.
MeasurePlan plan_measure(const MeasureArguments& arguments);

Command measure_command();

}  // namespace repose::cli
