#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose camera`, as typed.
struct CameraArguments {
  std::vector<std::string> pictures;  ///< files and folders
  std::string out_file;
  std::string square_mm;
  std::string json_file;
  std::string threads;
};

/// Runs `repose camera`.
ExitCode run_camera(const CameraArguments& arguments);

Command camera_command();

}  // namespace repose::cli
