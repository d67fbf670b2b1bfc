#pragma once

#include "cli/arguments.h"
#include "cli/exit_code.h"

namespace repose::cli {

/// Carries out `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
