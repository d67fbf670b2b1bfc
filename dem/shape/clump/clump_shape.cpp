#include "dem/shape/clump/clump_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/input_error.h"

namespace repose::dem {

double ClumpShape::reach_m() const {
  double reach = 0;
  for (const ClumpSphere& sphere : spheres) {
    reach = std::max(reach, sphere.centre.norm() + sphere.radius);
  }
  return reach;
}

ClumpShape sphere_shape(double radius_m) {
  if (!std::isfinite(radius_m) || radius_m <= 0) {
    throw base::InputError({.where = "sphere",
                            .value = "its radius is " + std::to_string(radius_m) + " m",
                            .fix = "give a radius above 0."});
  }
  ClumpShape shape;
  shape.spheres = {{.centre = Vector::Zero(), .radius = radius_m}};
  shape.volume_m3 = 4.0 / 3 * std::numbers::pi * radius_m * radius_m * radius_m;
  shape.gyration_m2 = Vector::Constant(2.0 / 5 * radius_m * radius_m);
  return shape;
}

}  // namespace repose::dem
