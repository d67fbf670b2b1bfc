#pragma once

#include "cli/calibrate/calibrate.h"

namespace repose::cli {

/// `repose calibrate --rolling-models A,B`: calibrates the study once with each, in subfolders of
/// the output folder; then determines which explains the bench readings best, and saves this in the
/// result of each.
ExitCode run_rolling_models(const CalibrateArguments& arguments);

}  // namespace repose::cli
