#pragma once

#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

struct ClumpSphere {
  Vector centre = Vector::Zero();  ///< m
  double radius = 0;               ///< m
};

/// A rigid grain: overlapping spheres for its contacts, its exact surface for its mass.
///
/// All in the principal frame: origin at the centre of mass, axes along the principal axes.
struct ClumpShape {
  std::vector<ClumpSphere> spheres;
  double volume_m3 = 0;                 ///< of the surface, not of the spheres
  Vector gyration_m2 = Vector::Zero();  ///< principal moments of inertia per unit mass
  Mesh surface;                         ///< for display; may be empty

  /// Largest extent of any sphere from the centre of mass, m.
  double reach_m() const;
};

/// A single sphere, which is its own exact surface; `surface` stays empty.
ClumpShape sphere_shape(double radius_m);

/// The shape with all lengths multiplied by a factor above 0.
ClumpShape scaled(const ClumpShape& shape, double factor);

/// Grains of one shape in several equally frequent sizes, the mean first.
///
/// Sizes are normally distributed by number, with the standard deviation `sd_fraction` of the mean.
/// Each of nine sizes represents a ninth of the grains: the median of that ninth, with its distance
/// from the mean increased by 7 % so that the nine have exactly that deviation. The smallest is
/// then 1.71 deviations below the mean. Without variation there is only the mean. Valid up to
/// kMaxSizeSd; proved by SizeClasses.* in tests/dem/grain_sizes_test.cpp.
std::vector<ClumpShape> size_classes(const ClumpShape& mean, double sd_fraction);

/// Maximum of `sd_fraction`: more widely varying sizes are hardly normally distributed.
inline constexpr double kMaxSizeSd = .2;

}  // namespace repose::dem
