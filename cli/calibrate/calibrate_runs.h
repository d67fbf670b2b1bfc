#pragma once

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Carries out `repose calibrate --runs`: the fit to a table of runs of another program.
ExitCode run_calibrate_runs(const CalibrateArguments& arguments);

}  // namespace repose::cli
