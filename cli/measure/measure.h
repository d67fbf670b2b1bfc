#pragma once

#include <string>
#include <vector>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// What `repose measure` is asked to do, as typed.
struct MeasureArguments {
  std::vector<std::string> pictures;  ///< and films: files and folders
  std::string method;
  std::string window;
  std::vector<std::string> exclude;
  std::string heap;
  std::string ground;
  std::vector<std::string> keep;
  std::vector<std::string> drop;
  std::string mask_file;
  std::string pitch_deg;
  std::string camera_file;
  bool finds_board = false;
  std::string square_mm;
  std::string board_behind_mm;
  std::string scale;
  std::string every;
  std::string fps;
  std::string threads;
  std::string overlay_folder;
  std::string json_file;
  std::string csv_file;
  std::string summary_file;
  std::string report_file;
  bool shows_definitions = false;
  bool saves_hints = false;
};

/// Carries out `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
