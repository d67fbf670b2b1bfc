#include "dem/shape/clump/size_classes.h"

#include <array>
#include <cmath>

namespace repose::dem {
namespace {

/// Quantiles of the standard normal distribution at 11/18, 13/18, 15/18 and 17/18: the medians of
/// the ninths above the middle one.
constexpr std::array<double, 4> kMedians = {.282216, .589456, .967422, 1.593219};

/// By which the medians are multiplied so that the nine of them have the deviation 1.
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
