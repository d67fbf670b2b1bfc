#pragma once

#include <array>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

using Bounds = Eigen::AlignedBox3d;

/// A point on a triangle, and the part of the triangle it lies on.
struct TrianglePoint {
  enum class Part { face, edge, corner };
  Vector point = Vector::Zero();
  Part part = Part::face;
  int index = 0;  ///< of the corner, or of the edge from corner `index` to the next
};

/// Source: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
TrianglePoint nearest_on_triangle(const Vector& point, const Vector& a, const Vector& b,
                                  const Vector& c);

/// Bounding-box hierarchy of triangles. The mesh must outlive it.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh& mesh);

  struct Nearest {
    int triangle = -1;
    TrianglePoint where;
    double squared_distance = 0;
  };
  /// The point of the surface nearest to `point`; ties are resolved deterministically.
  Nearest nearest(const Vector& point) const;

  /// Appends the triangles whose bounds touch `bounds`.
  void append_touching(const Bounds& bounds, std::vector<int>& found) const;

 private:
  struct Node {
    Bounds bounds;
    int first = 0;  ///< leaf: first of its triangles in order_; else: its right child
    int count = 0;  ///< leaf: how many triangles; else 0, and the left child comes next
  };
  int build(std::size_t first, std::size_t last, const std::vector<Bounds>& bounds);

  const Mesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// Bounds of one triangle of a mesh.
Bounds bounds_of(const Mesh& mesh, const std::array<int, 3>& triangle);

}  // namespace repose::dem
