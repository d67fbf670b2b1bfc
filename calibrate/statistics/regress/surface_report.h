#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {

/// A fitted surface and everything derived from it.
struct SurfaceReport {
  Regression fit;
  std::optional<CanonicalForm> form;
  BoxExtremes extremes;
  std::optional<TargetSet> target;
  std::vector<SurfaceDiagnostic> diagnostics;
};

/// @param target  a target response
SurfaceReport report_on(Regression fit, const std::optional<WantedValue>& target,
                        base::FieldNames names = {});

/// Names of models and shapes in files and tables.
inline constexpr std::array<std::pair<SurfaceModel, std::string_view>, 3> kSurfaceModelNames = {
    {{SurfaceModel::linear, "linear"},
     {SurfaceModel::interaction, "interaction"},
     {SurfaceModel::quadratic, "quadratic"}}};
inline constexpr std::array<std::pair<SurfaceShape, std::string_view>, 3> kSurfaceShapeNames = {
    {{SurfaceShape::minimum, "minimum"},
     {SurfaceShape::maximum, "maximum"},
     {SurfaceShape::saddle, "saddle"}}};

std::string name_of(SurfaceModel model);
std::string name_of(SurfaceShape shape);

}  // namespace repose::calibrate
