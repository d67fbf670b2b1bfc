#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/regress/surface_report.h"
#include "cli/statistics/regress.h"

namespace repose::cli {

/// A `repose regress` worked out, but for its output.
struct RegressPlan {
  calibrate::SurfaceModel model = calibrate::SurfaceModel::quadratic;
  std::optional<calibrate::WantedValue> target;
  std::string json_file;
  calibrate::SurfaceReport report;
  std::vector<calibrate::LeftOut> left_out;
  std::vector<std::string> notes;

  std::vector<std::string> errors;  ///< empty: it can be carried out
};

/// Reads all that was typed and the table that it names, and fits the surface. All errors at once.
RegressPlan plan_regress(const RegressArguments& arguments);

}  // namespace repose::cli
