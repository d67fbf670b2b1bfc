#pragma once

#include <string>

#include "cli/statistics/surface_report.h"

namespace repose::cli {

/// For people: coefficients, analysis of variance, shape, extremes, target, warnings.
std::string regress_table(const SurfaceReport& report, int columns);

}  // namespace repose::cli
