#pragma once

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Whether the study states how its runs are made: [engine]. False if it cannot be read.
bool has_engine(const CalibrateArguments& arguments);

/// Runs `repose calibrate` for a study with [engine], whose command makes the runs.
ExitCode run_calibrate_engine(const CalibrateArguments& arguments);

}  // namespace repose::cli
