#pragma once

#include <vector>

#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/triangle_tree.h"
#include "dem/wall/closest.h"

namespace repose::dem {

/// The triangles of a mesh as walls, each edge and corner of them just once.
///
/// A sphere near a shared edge is near both its triangles at the same point. The contact then
/// belongs to the edge's triangle of the lowest number, and only when neither triangle is nearer by
/// its face; likewise at corners. A sphere in a fold touches two faces: those are two contacts.
/// Proved by MeshWall.* in tests/dem/mesh_wall_test.cpp.
class MeshFacets {
 public:
  /// Throws base::InputError for a mesh without triangles, or with one without area.
  explicit MeshFacets(const Mesh& mesh);
  ~MeshFacets() = default;
  MeshFacets(const MeshFacets&) = delete;  // the tree refers to the mesh beside it
  MeshFacets& operator=(const MeshFacets&) = delete;

  /// Triangles within `distance` of a point, in rising order.
  void near(const Vector& point, double distance, std::vector<int>& facets) const;

  /// The nearest point of one triangle, when the contact there belongs to it; else a distance
  /// without end. In the frame of the mesh.
  Closest closest(int facet, const Vector& point) const;

 private:
  TrianglePoint nearest(int facet, const Vector& point) const;
  bool owns(int facet, const TrianglePoint& spot, const Vector& point) const;

  Mesh mesh_;  ///< corners at the same place are one
  TriangleTree tree_;
  std::vector<int> corner_start_;      ///< one more than corners: where each one's triangles start
  std::vector<int> corner_triangles_;  ///< rising
};

}  // namespace repose::dem
