#pragma once

#include <Eigen/Core>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Of a solid of uniform density.
struct MassProperties {
  double volume_m3 = 0;
  Vector centroid = Vector::Zero();                            ///< m
  Eigen::Matrix3d second_moment_m2 = Eigen::Matrix3d::Zero();  ///< mean of x xT about the centroid
};

/// Exact for the body inside a watertight surface: the sum over the tetrahedra between its
/// triangles and one point.
///
///     V = sum det / 6      int x = sum det/24 s      int x xT = sum det/120 (aaT + bbT + ccT +
///     ssT)
///
///     a, b, c  corners of a triangle, from the common point    m    s = a + b + c, det = a.(b x c)
///
/// Source: Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor in terms of its
/// vertex coordinates, J. Math. Stat. 1 (2005) 8-11; equals Mirtich, Fast and accurate computation
/// of polyhedral mass properties, J. Graphics Tools 1 (1996). Proved by
/// tests/dem/shape_mass_properties_test.cpp.
MassProperties mass_properties(const Mesh& mesh);

/// Inertia tensor per unit mass, I/m = tr(C) 1 - C, where C is the mean of x xT.
Eigen::Matrix3d gyration_of(const Eigen::Matrix3d& second_moment_m2);

/// Where a body's own frame lies.
struct PrincipalFrame {
  Vector origin = Vector::Zero();                      ///< centre of mass, in the scan's frame
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< its columns, right-handed
  Vector gyration_m2 = Vector::Zero();                 ///< ascending: x is the long axis
};

/// Principal axes by ascending moment of inertia. x and y point to where the body reaches farther
/// out: the mean of x^3 and of y^3 is not negative; where it vanishes, the axis has its largest
/// part positive in the scan's frame. Axes of equal moments keep as close to the scan's as they
/// can.
PrincipalFrame principal_frame(const Mesh& mesh);

/// The surface as seen from the frame.
Mesh in_frame(const Mesh& mesh, const PrincipalFrame& frame);

}  // namespace repose::dem
