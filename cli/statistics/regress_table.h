#pragma once

#include <string>

#include "calibrate/statistics/regress/surface_report.h"

namespace repose::cli {

/// For people: coefficients, analysis of variance, shape, extremes, target, warnings.
std::string regress_table(const calibrate::SurfaceReport& report, int columns);

}  // namespace repose::cli
