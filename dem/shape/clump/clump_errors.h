#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Number of groups of spheres that do not touch each other. More than one is not a valid grain:
/// others could pass through the gap.
int sphere_groups(const std::vector<ClumpSphere>& spheres);

/// Differences between the union of a clump's spheres and the body it represents.
struct ClumpErrors {
  /// Volume in only one of the two (missing or protruding), per volume of the body. At least the
  /// plain difference of the volumes, in which gaps and bulges cancel.
  double volume_error = 0;
  /// (Union - body) / body.
  double volume_difference = 0;
  /// |I_union - I_body| / |I_body|, Frobenius norms of the inertia tensors about the body's centre
  /// of mass at equal density. The engine uses the body's own tensor.
  double inertia_error = 0;
  /// Distances between the two surfaces in both directions, each weighted one half. m
  double surface_error_mean_m = 0;
  double surface_error_p95_m = 0;
  double sticks_out_m = 0;   ///< farthest point of a sphere outside the body
  double falls_short_m = 0;  ///< farthest point of the body outside the spheres
};

/// Compares spheres with a watertight surface in the same frame. Lengths along 256 x 256 columns
/// are exact; distances use 20,000 points per surface.
ClumpErrors clump_errors(const Mesh& mesh, const std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
