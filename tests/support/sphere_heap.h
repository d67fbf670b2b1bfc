#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dem/shape/clump/clump_shape.h"

/// Heaps of small spheres with known surfaces.
namespace repose::testing {

/// A cone of small spheres whose surface is the cone's, to within the spheres' bumps.
inline std::vector<dem::ClumpSphere> sphere_cone(double angle_deg, double height_m, double radius_m,
                                                 const dem::Vector& at = dem::Vector::Zero()) {
  std::vector<dem::ClumpSphere> spheres;
  const double slope = std::tan(angle_deg * std::numbers::pi / 180);
  const double step = radius_m;
  const int reach = static_cast<int>(height_m / slope / step) + 1;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const double top = height_m - step * std::hypot(i, j) * slope;
      if (top < radius_m) continue;
      spheres.push_back(
          {.centre = at + dem::Vector(i * step, j * step, top - radius_m), .radius = radius_m});
    }
  }
  return spheres;
}

/// The same with a flat top of this radius.
inline std::vector<dem::ClumpSphere> sphere_frustum(double angle_deg, double height_m, double top_m,
                                                    double radius_m) {
  const double cut_off_m = top_m * std::tan(angle_deg * std::numbers::pi / 180);
  std::vector<dem::ClumpSphere> spheres = sphere_cone(angle_deg, height_m + cut_off_m, radius_m);
  for (dem::ClumpSphere& sphere : spheres) {
    sphere.centre.z() = std::min(sphere.centre.z(), height_m - radius_m);
  }
  return spheres;
}

}  // namespace repose::testing
