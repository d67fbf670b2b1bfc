#pragma once

#include <string>
#include <vector>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// `repose calibrate`, as typed.
struct CalibrateArguments {
  std::string study;
  std::vector<std::string> settings;
  std::string method = "joint";
  std::string budget = "quick";
  std::string rolling_models;
  std::string jobs;
  std::string out_folder;
  std::string json_file;
  bool is_dry_run = false;
};

/// Carries out `repose calibrate`.
ExitCode run_calibrate(const CalibrateArguments& arguments);

}  // namespace repose::cli
