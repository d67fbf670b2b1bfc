#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose plan`, as typed.
struct PlanArguments {
  std::string study;
  std::vector<std::string> settings;
  std::string experiments;
  std::string readings;
  std::string minutes;
  std::string jobs;
  std::string out_folder;
  std::string json_file;
};

/// Runs `repose plan`.
ExitCode run_plan(const PlanArguments& arguments);

/// `repose plan`.
Command plan_command();

}  // namespace repose::cli
