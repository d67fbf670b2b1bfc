#pragma once

#include <string>

#include "cli/statistics/surface_report.h"

namespace repose::cli {

/// Everything, for programs. Numbers that do not exist are null.
std::string regress_json(const SurfaceReport& report);

}  // namespace repose::cli
