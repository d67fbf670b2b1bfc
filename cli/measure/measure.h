#pragma once

#include <string>
#include <vector>

#include "cli/common/exit_code.h"
#include "cli/common/scale_option.h"

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
  ScaleArguments scale;
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

/// Carries out `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
