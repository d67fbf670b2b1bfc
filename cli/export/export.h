#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose export`, as typed.
struct ExportArguments {
  std::string folder;  ///< of the study
  std::string target;
  bool takes_approximate = false;
  std::string set_number;
  std::string out_folder;
  std::string json_file;
};

/// Runs `repose export`.
ExitCode run_export(const ExportArguments& arguments);

Command export_command();

}  // namespace repose::cli
