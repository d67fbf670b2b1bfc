#pragma once

#include <string>

#include "cli/statistics/regress_options.h"

namespace repose::cli {

/// For people: coefficients, analysis of variance, shape, extremes, target, warnings, and
/// what of the table was not used.
std::string regress_table(const RegressPlan& plan, int columns);

}  // namespace repose::cli
