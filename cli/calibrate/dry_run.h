#pragma once

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// `repose calibrate --dry-run`: times a run of each experiment and tells what the budgets would
/// do. Writes nothing.
ExitCode run_dry(const CalibratePlan& plan);

}  // namespace repose::cli
