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

}  // namespace repose::dem
