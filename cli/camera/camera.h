#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// What `repose camera` is asked to do, as typed.
struct CameraArguments {
  std::vector<std::string> pictures;  ///< files and folders
  std::string out_file;
  std::string square_mm;
  std::string json_file;
  std::string threads;
};

/// Carries out `repose camera`.
ExitCode run_camera(const CameraArguments& arguments);

Command camera_command();

}  // namespace repose::cli
