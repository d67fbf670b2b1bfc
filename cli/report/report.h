#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose report`, as typed.
struct ReportArguments {
  std::string folder;         ///< that repose calibrate --out wrote
  std::string out_file;       ///< empty: FOLDER/report.html
  std::string tables_folder;  ///< empty: FOLDER/tables; "none": no tables
};

/// Runs `repose report`.
ExitCode run_report(const ReportArguments& arguments);

Command report_command();

}  // namespace repose::cli
