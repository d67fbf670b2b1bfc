#pragma once

#include <atomic>

#include "cli/common/exit_code.h"
#include "cli/compare/compare_options.h"

namespace repose::cli {

/// Carries out `repose compare` where one of both is more than one picture.
ExitCode compare_sets(ComparePlan plan, const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
