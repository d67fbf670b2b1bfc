#include "dem/shape/clump/clump_shape.h"

#include <algorithm>
#include <array>
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

namespace {

/// Quantiles of the standard normal distribution at 11/18, 13/18, 15/18 and 17/18: the medians of
/// the ninths above the middle one.
constexpr std::array<double, 4> kMedians = {.282216, .589456, .967422, 1.593219};

/// Factor on the medians that gives the nine of them a standard deviation of 1.
double stretch() {
  double sum = 0;
  for (const double median : kMedians) sum += 2 * median * median;
  return std::sqrt(static_cast<double>(2 * kMedians.size() + 1) / sum);
}

}  // namespace

ClumpShape scaled(const ClumpShape& shape, double factor) {
  ClumpShape made = shape;
  for (ClumpSphere& sphere : made.spheres) {
    sphere.centre *= factor;
    sphere.radius *= factor;
  }
  for (Vector& vertex : made.surface.vertices) vertex *= factor;
  made.volume_m3 *= factor * factor * factor;
  made.gyration_m2 *= factor * factor;
  return made;
}

std::vector<ClumpShape> size_classes(const ClumpShape& mean, double sd_fraction) {
  std::vector<ClumpShape> classes = {mean};
  if (sd_fraction == 0) return classes;
  for (const double median : kMedians) {
    for (const double side : {-1., 1.}) {
      classes.push_back(scaled(mean, 1 + side * sd_fraction * stretch() * median));
    }
  }
  return classes;
}

}  // namespace repose::dem
