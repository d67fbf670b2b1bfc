#pragma once

#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// What a calliper tells of a grain.
struct CalliperSizes {
  double length_m = 0;
  double width_m = 0;
  double thickness_m = 0;
  /// 0: both ends round, an ellipsoid; 1: the end at +x comes to a point. A hazelnut is about .5.
  double tip_fraction = 0;

  bool operator==(const CalliperSizes&) const = default;

  /// Empty when usable; else a line for each error.
  std::vector<base::Fault> problems() const;
};

/// A closed surface whose bounding box is length x width x thickness along x, y, z, to the last
/// digit, centred on the origin.
///
///     half width at x = W/2 (1 - u^2)^q     u = 2x/L     q = 1/2 for x <= 0, (1 + tip)/2 for x > 0
///
/// and the same with T: an ellipse across, half an ellipsoid at -x, and at +x, for tip = 1, a
/// parabola that meets the axis at a slope of W/L. Both halves have the same width and tangent
/// where they meet. As a polyhedron inside the smooth body it has .2 % less volume.
/// @throws base::InputError  all that is wrong with the sizes, a line each.
Mesh calliper_surface(const CalliperSizes& sizes);

}  // namespace repose::dem
