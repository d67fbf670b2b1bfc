#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/statistics/regress/surface.h"

namespace repose::cli {

/// All that is known of a fitted surface.
struct SurfaceReport {
  calibrate::Regression fit;
  std::optional<calibrate::CanonicalForm> form;
  calibrate::BoxExtremes extremes;
  std::optional<calibrate::TargetSet> target;
  std::vector<calibrate::SurfaceDiagnostic> diagnostics;
};

inline SurfaceReport report_on(calibrate::Regression fit, std::optional<double> target) {
  SurfaceReport report;
  report.form = canonical_form(fit);
  report.extremes = extremes_in_box(fit);
  if (target) report.target = solve_target(fit, *target);
  report.diagnostics = diagnostics_of(fit, report.form, report.extremes, report.target);
  report.fit = std::move(fit);
  return report;
}

inline std::string_view name_of(calibrate::SurfaceModel model) {
  switch (model) {
    case calibrate::SurfaceModel::linear:
      return "linear";
    case calibrate::SurfaceModel::interaction:
      return "interaction";
    case calibrate::SurfaceModel::quadratic:
      break;
  }
  return "quadratic";
}

inline std::string_view name_of(calibrate::SurfaceShape shape) {
  switch (shape) {
    case calibrate::SurfaceShape::minimum:
      return "minimum";
    case calibrate::SurfaceShape::maximum:
      return "maximum";
    case calibrate::SurfaceShape::saddle:
      break;
  }
  return "saddle";
}

}  // namespace repose::cli
