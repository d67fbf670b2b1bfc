#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "dem/vector.h"

namespace repose::dem {

/// A triangulated surface, counter-clockwise seen from outside. Metres.
struct Mesh {
  std::vector<Vector> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// One side of one triangle: the edge between two corners, low < high.
struct EdgeUse {
  int low = 0;
  int high = 0;
  int triangle = 0;
  int side = 0;            ///< 0, 1, 2: from corner `side` to the next
  bool is_upward = false;  ///< the triangle runs from low to high
};

/// All sides of all triangles, grouped by edge, in a fixed order.
std::vector<EdgeUse> edge_uses(const Mesh& mesh);

/// Calls visit(std::span<const EdgeUse>) for each edge, with the triangle sides that meet there.
template <typename Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low &&
           uses[last].high == uses[first].high) {
      ++last;
    }
    visit(uses.subspan(first, last - first));
  }
}

/// Whether every edge belongs to exactly two triangles that traverse it in opposite directions.
bool is_watertight(const Mesh& mesh);

inline const Vector& corner(const Mesh& mesh, const std::array<int, 3>& triangle, std::size_t i) {
  return mesh.vertices[static_cast<std::size_t>(triangle[i])];
}

/// Outward normal, of twice the triangle's area in length.
inline Vector area_normal(const Mesh& mesh, const std::array<int, 3>& triangle) {
  const Vector& a = corner(mesh, triangle, 0);
  return (corner(mesh, triangle, 1) - a).cross(corner(mesh, triangle, 2) - a);
}

inline double area_m2(const Mesh& mesh, const std::array<int, 3>& triangle) {
  return area_normal(mesh, triangle).norm() / 2;
}

inline double area_m2(const Mesh& mesh) {
  double area = 0;
  for (const auto& triangle : mesh.triangles) area += area_m2(mesh, triangle);
  return area;
}

inline Eigen::AlignedBox3d bounds_of(const Mesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Vector& vertex : mesh.vertices) bounds.extend(vertex);
  return bounds;
}

/// Mass properties of a solid of uniform density.
struct MassProperties {
  double volume_m3 = 0;
  Vector centroid = Vector::Zero();                            ///< m
  Eigen::Matrix3d second_moment_m2 = Eigen::Matrix3d::Zero();  ///< mean of x xT about the centroid
};

/// Exact for the body inside a watertight surface: the sum over the tetrahedra formed by its
/// triangles and one common point.
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

/// A body's own frame.
struct PrincipalFrame {
  Vector origin = Vector::Zero();                      ///< centre of mass, in the scan's frame
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< its columns, right-handed
  Vector gyration_m2 = Vector::Zero();                 ///< ascending: x is the long axis
};

/// Principal axes by ascending moment of inertia. x and y point to the side on which the body
/// extends farther: the means of x^3 and y^3 are not negative; if one vanishes, the axis has its
/// largest component positive in the scan's frame. Axes of equal moments are chosen as close to the
/// scan's as possible.
PrincipalFrame principal_frame(const Mesh& mesh);

/// The surface in the coordinates of the frame.
Mesh in_frame(const Mesh& mesh, const PrincipalFrame& frame);

}  // namespace repose::dem
