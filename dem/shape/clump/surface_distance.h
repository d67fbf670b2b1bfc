#pragma once

#include <array>
#include <vector>

#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/triangle_tree.h"

namespace repose::dem {

/// Distances from a watertight surface. The mesh must outlive it.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Mesh& mesh);

  /// Below 0 inside. The sign comes from the normal at the nearest point, at corners weighted by
  /// angle and at edges the sum of both faces'.
  /// Source: Baerentzen & Aanaes, Signed distance computation using the angle weighted
  /// pseudonormal, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243-253.
  double signed_distance(const Vector& point) const;

 private:
  Vector normal_at(const TriangleTree::Nearest& nearest) const;

  const Mesh& mesh_;
  TriangleTree tree_;
  std::vector<Vector> face_normals_;
  std::vector<Vector> corner_normals_;
  std::vector<std::array<Vector, 3>> edge_normals_;  ///< by triangle and side
};

}  // namespace repose::dem
