#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/exit_code.h"

namespace repose::cli {

/// Its options by the fields that the library finds fault with.
inline constexpr std::array<base::FieldName, 3> kCalibrateFields{
    {{"budget", "--budget"}, {"setting", "--set"}, {"the joint method", "--method joint"}}};

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
