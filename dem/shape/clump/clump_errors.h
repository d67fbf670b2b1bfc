#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// How many groups the spheres fall into that do not touch each other. More than one is no grain:
/// others could pass through the gap.
int sphere_groups(const std::vector<ClumpSphere>& spheres);

/// How much the union of a clump's spheres differs from the body it stands for.
struct ClumpErrors {
  /// Volume in one of the two only (missing and sticking out), per volume of the body. Never less
  /// than the plain difference of the volumes, in which gaps and bulges cancel.
  double volume_error = 0;
  /// (Union - body) / body.
  double volume_difference = 0;
  /// |I_union - I_body| / |I_body|, Frobenius norms of the inertia tensors about the body's centre
  /// of mass at equal density. The engine uses the body's own.
  double inertia_error = 0;
  /// Distances between the two surfaces, both ways, each way for half. m
  double surface_error_mean_m = 0;
  double surface_error_p95_m = 0;
  double sticks_out_m = 0;   ///< farthest point of a sphere outside the body
  double falls_short_m = 0;  ///< farthest point of the body outside the spheres
};

/// Compares spheres with a watertight surface in the same frame. Lengths along 256 x 256 columns
/// are exact, distances come from 20,000 points a surface.
ClumpErrors clump_errors(const Mesh& mesh, const std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
