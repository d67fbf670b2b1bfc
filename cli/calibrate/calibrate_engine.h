#pragma once

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Whether the study says how its runs are made: [engine]. False where it cannot be read.
bool has_engine(const CalibrateArguments& arguments);

/// Carries out `repose calibrate` of a study with [engine], whose command makes the runs.
ExitCode run_calibrate_engine(const CalibrateArguments& arguments);

}  // namespace repose::cli
