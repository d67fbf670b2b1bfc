#pragma once

#include <array>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

inline const Vector& corner(const Mesh& mesh, const std::array<int, 3>& triangle, std::size_t i) {
  return mesh.vertices[static_cast<std::size_t>(triangle[i])];
}

/// Twice the triangle's area long, outwards.
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

}  // namespace repose::dem
