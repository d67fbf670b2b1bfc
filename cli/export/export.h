#pragma once

#include <string>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// What `repose export` is asked to do, as typed.
struct ExportArguments {
  std::string folder;  ///< of the study
  std::string target;
  bool takes_approximate = false;
  std::string set_number;
  std::string out_folder;
  std::string json_file;
};

/// Carries out `repose export`.
ExitCode run_export(const ExportArguments& arguments);

}  // namespace repose::cli
