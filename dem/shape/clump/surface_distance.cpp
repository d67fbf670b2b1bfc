#include "dem/shape/clump/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "dem/shape/scan/mesh_edges.h"
#include "dem/shape/scan/mesh_measure.h"

namespace repose::dem {
namespace {

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh)
    : mesh_(mesh),
      tree_(mesh),
      corner_normals_(mesh.vertices.size(), Vector::Zero()),
      edge_normals_(mesh.triangles.size()) {
  face_normals_.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const Vector normal = area_normal(mesh, triangle).stableNormalized();
    face_normals_.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector& here = corner(mesh, triangle, i);
      const double angle = angle_between(corner(mesh, triangle, (i + 1) % 3) - here,
                                         corner(mesh, triangle, (i + 2) % 3) - here);
      corner_normals_[static_cast<std::size_t>(triangle[i])] += angle * normal;
    }
  }
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    Vector sum = Vector::Zero();
    for (const EdgeUse& use : edge) sum += face_normals_[static_cast<std::size_t>(use.triangle)];
    for (const EdgeUse& use : edge) {
      edge_normals_[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] =
          sum;
    }
  });
}

Vector SurfaceDistance::normal_at(const TriangleTree::Nearest& nearest) const {
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const auto index = static_cast<std::size_t>(nearest.where.index);
  switch (nearest.where.part) {
    case TrianglePoint::Part::corner:
      return corner_normals_[static_cast<std::size_t>(mesh_.triangles[triangle][index])];
    case TrianglePoint::Part::edge:
      return edge_normals_[triangle][index];
    case TrianglePoint::Part::face:
      break;
  }
  return face_normals_[triangle];
}

double SurfaceDistance::signed_distance(const Vector& point) const {
  const TriangleTree::Nearest nearest = tree_.nearest(point);
  const double distance = std::sqrt(nearest.squared_distance);
  return normal_at(nearest).dot(point - nearest.where.point) < 0 ? -distance : distance;
}

}  // namespace repose::dem
