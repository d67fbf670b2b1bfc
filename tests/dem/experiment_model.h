#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "dem/experiment/experiment.h"
#include "tests/support/error_of.h"

namespace repose::dem::test {

/// A hazelnut as a sphere of equal volume, on steel. Tests may change any coefficient.
inline Model sphere_bench() {
  Model model;
  model.grain = sphere_shape(9.6349e-3);
  model.grain_material = {"nut", 851, 1.254e9, .38};
  model.wall_material = {"steel", 7850, 2.1e11, .3};
  model.grain_wall = {.31, .39, .04};
  model.grain_grain = {.11, .21, .04};
  return model;
}

/// Soft spheres that form a heap, and creep.
inline Model soft_bench() {
  Model model = sphere_bench();
  model.stiffness_factor = 1e-3;
  model.grain_wall = {.31, .5, .2};
  model.grain_grain = {.11, .5, .2};
  return model;
}

/// Spheres on the long axis (x) of a spheroid, each as large as fits inside it.
inline ClumpShape spheroid_clump(int count) {
  const double a = 11.24e-3;
  const double b = 8.92e-3;
  const double end = (a * a - b * b) / a;
  ClumpShape shape;
  for (int k = 0; k < count; ++k) {
    const double x = end * (2.0 * k / (count - 1) - 1);
    shape.spheres.push_back(
        {.centre = {x, 0, 0}, .radius = b * std::sqrt(1 - x * x / (a * a - b * b))});
  }
  shape.volume_m3 = 4.0 / 3 * std::numbers::pi * a * b * b;
  shape.gyration_m2 = Vector(2 * b * b, a * a + b * b, a * a + b * b) / 5;
  return shape;
}

inline Model clump_bench() {
  Model model = sphere_bench();
  model.grain = spheroid_clump(11);
  return model;
}

/// Whether all positions and orientations are bit-identical.
inline bool same_state(const Simulation& a, const Simulation& b) {
  if (a.grain_count() != b.grain_count() || a.step() != b.step()) return false;
  for (int k = 0; k < a.grain_count(); ++k) {
    if (a.is_present(k) != b.is_present(k)) return false;
    if (a.grain(k).position != b.grain(k).position) return false;
    if (a.grain(k).orientation.coeffs() != b.grain(k).orientation.coeffs()) return false;
  }
  return true;
}

}  // namespace repose::dem::test
