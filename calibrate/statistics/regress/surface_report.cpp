#include "calibrate/statistics/regress/surface_report.h"

namespace repose::calibrate {
namespace {

template <typename Names, typename Value>
std::string name_in(const Names& names, Value value) {
  for (const auto& [known, name] : names) {
    if (known == value) return std::string(name);
  }
  return {};
}

}  // namespace

SurfaceReport report_on(Regression fit, const std::optional<WantedValue>& target,
                        base::FieldNames names) {
  SurfaceReport report;
  report.form = canonical_form(fit);
  report.extremes = extremes_in_box(fit);
  if (target) report.target = solve_target(fit, *target);
  report.diagnostics = diagnostics_of(fit, report.form, report.extremes, report.target, names);
  report.fit = std::move(fit);
  return report;
}

std::string name_of(SurfaceModel model) { return name_in(kSurfaceModelNames, model); }
std::string name_of(SurfaceShape shape) { return name_in(kSurfaceShapeNames, shape); }

}  // namespace repose::calibrate
