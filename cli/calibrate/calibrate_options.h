#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/run/run_study.h"
#include "calibrate/statistics/table/table.h"
#include "cli/common/command.h"

namespace repose::cli {

/// Maps the fields named in library errors to options.
inline constexpr std::array<base::FieldName, 6> kCalibrateFields{
    {{"budget", "--budget"},
     {"minutes", "--minutes"},
     {"fidelity", "--fidelity"},
     {"setting", "--set"},
     {"the joint method", "--method joint"},
     {"max_runs", "--max-runs"}}};

/// The arguments of `repose calibrate`, as typed.
struct CalibrateArguments {
  std::string study;
  std::vector<std::string> settings;
  std::string method = "joint";
  std::string budget = "quick";
  std::string minutes = {};  ///< instead of a budget
  std::string fidelity = "mixed";
  std::string rolling_models;
  std::vector<std::string> runs = {};  ///< tables from another program; empty: simulated here
  std::string max_runs = {};           ///< for a study with [engine]
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
  std::vector<std::string> notes;   ///< for the user
};

/// Reads the study and its bench measurements for a command that simulates in the study's folder: a
/// complete plan except for its problem.
CalibratePlan read_bench(const CalibrateArguments& arguments, calibrate::NoRows no_rows);

/// @throws dem::Interrupted  while measuring how much --minutes allows
CalibratePlan plan_calibrate(const CalibrateArguments& arguments);

Command calibrate_command();

}  // namespace repose::cli
