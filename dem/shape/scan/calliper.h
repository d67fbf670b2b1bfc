#pragma once

#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Calliper measurements of a grain.
struct CalliperSizes {
  double length_m = 0;
  double width_m = 0;
  double thickness_m = 0;
  /// 0: both ends round, an ellipsoid; 1: the end at +x is a point. A hazelnut is about .5.
  double tip_fraction = 0;

  bool operator==(const CalliperSizes&) const = default;

  /// Empty if usable; else one line per error.
  std::vector<base::Fault> problems() const;
};

/// A closed surface whose bounding box is exactly length x width x thickness along x, y, z, centred
/// on the origin.
///
///     half width at x = W/2 (1 - u^2)^q     u = 2x/L     q = 1/2 for x <= 0, (1 + tip)/2 for x > 0
///
/// and the same with T: elliptical cross-sections, half an ellipsoid at -x, and at +x, for tip = 1,
/// a parabola that meets the axis at a slope of W/L. Both halves have the same width and tangent
/// where they meet. The inscribed polyhedron has .2 % less volume than the smooth body.
/// @throws base::InputError  all errors in the sizes, one line each.
Mesh calliper_surface(const CalliperSizes& sizes);

}  // namespace repose::dem
