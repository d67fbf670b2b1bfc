#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/shape/shape.h"
#include "dem/shape/clump/fill.h"
#include "dem/shape/clump/shape_export.h"
#include "dem/shape/scan/calliper.h"
#include "dem/shape/scan/scan.h"

namespace repose::cli {

/// Its options by the fields that the library finds fault with.
inline constexpr std::array<base::FieldName, 6> kShapeFields{
    {{"size", "--size-mm"},
     {"tip", "--tip"},
     {"volume error", "--volume-error"},
     {"its unit", "--unit"},
     {"more spheres", "--spheres"},
     {"smaller volume error", "--volume-error"}}};

/// What the words of `repose shape` come down to.
struct ShapePlan {
  std::optional<dem::CalliperSizes> sizes;  ///< else the scan is read
  dem::ScanUnit unit = dem::ScanUnit::millimetre;
  dem::FillOptions fill;
  std::optional<double> density_kg_m3;
  dem::ShapeFormat mesh_format = dem::ShapeFormat::glb;
  std::vector<std::string> errors;  ///< all of them; empty when it can be carried out
};

ShapePlan plan_shape(const ShapeArguments& arguments);

}  // namespace repose::cli
