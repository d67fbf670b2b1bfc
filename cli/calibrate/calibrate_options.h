#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/run/run_study.h"
#include "calibrate/statistics/table/table.h"
#include "cli/common/command.h"

namespace repose::cli {

/// Its options by the fields that the library finds fault with.
inline constexpr std::array<base::FieldName, 6> kCalibrateFields{
    {{"budget", "--budget"},
     {"minutes", "--minutes"},
     {"fidelity", "--fidelity"},
     {"setting", "--set"},
     {"the joint method", "--method joint"},
     {"max_runs", "--max-runs"}}};

/// `repose calibrate`, as typed.
struct CalibrateArguments {
  std::string study;
  std::vector<std::string> settings;
  std::string method = "joint";
  std::string budget = "quick";
  std::string minutes = {};  ///< in place of a budget
  std::string fidelity = "mixed";
  std::string rolling_models;
  std::vector<std::string> runs = {};  ///< tables of another program's; empty: simulated here
  std::string max_runs = {};           ///< of a study with [engine]
  std::string jobs;
  std::string out_folder;
  std::string json_file;
  std::string progress_file = {};
  bool is_dry_run = false;
};

/// What `repose calibrate` will do.
struct CalibratePlan : calibrate::PreparedStudy {
  std::string json_file;
  std::string progress_file;
  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user to know
};

/// The study and what its bench gave, for a command that simulates in the study's folder: all of a
/// plan but its problem.
CalibratePlan read_bench(const CalibrateArguments& arguments, calibrate::NoRows no_rows);

/// @throws dem::Interrupted  while it was timed what --minutes allow for
CalibratePlan plan_calibrate(const CalibrateArguments& arguments);

Command calibrate_command();

}  // namespace repose::cli
