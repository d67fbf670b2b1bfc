#pragma once

#include "cli/calibrate/calibrate.h"

namespace repose::cli {

/// `repose calibrate --rolling-models A,B`: the study once with each, in folders of their own
/// inside the output folder; then which of them explains the bench readings best, which is kept in
/// the result of each.
ExitCode run_rolling_models(const CalibrateArguments& arguments);

}  // namespace repose::cli
