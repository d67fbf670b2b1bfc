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
/// All of it in the principal frame: origin at the centre of mass, axes along the principal axes.
struct ClumpShape {
  std::vector<ClumpSphere> spheres;
  double volume_m3 = 0;                 ///< of the surface, not of the spheres
  Vector gyration_m2 = Vector::Zero();  ///< principal moments of inertia per unit mass
  Mesh surface;                         ///< to look at; may be empty

  /// Farthest that any sphere reaches from the centre of mass, m.
  double reach_m() const;
};

/// One sphere that is its own surface.
ClumpShape sphere_shape(double radius_m);

/// The shape, all its lengths multiplied by a factor above 0.
ClumpShape scaled(const ClumpShape& shape, double factor);

/// Grains of one shape whose sizes vary: equally frequent sizes, the mean first.
///
/// Sizes are normally distributed by number, with the standard deviation `sd_fraction` of the mean.
/// Each of nine sizes stands for a ninth of the grains: it is the median of that ninth, moved from
/// the mean by as much more (7 %) as gives all nine exactly that deviation. The smallest is then
/// 1.71 deviations below the mean. Without variation there is the mean alone.
/// Valid up to kMaxSizeSd; proved by SizeClasses.* in tests/dem/grain_sizes_test.cpp.
std::vector<ClumpShape> size_classes(const ClumpShape& mean, double sd_fraction);

/// Of `sd_fraction`: grains that vary more are hardly normally distributed.
inline constexpr double kMaxSizeSd = .2;

}  // namespace repose::dem
