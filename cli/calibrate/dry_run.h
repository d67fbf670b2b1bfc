#pragma once

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// `repose calibrate --dry-run`: times a run of each experiment and shows what each budget would
/// do. Writes nothing.
ExitCode run_dry(const CalibratePlan& plan);

}  // namespace repose::cli
