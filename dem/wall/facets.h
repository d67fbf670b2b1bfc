#pragma once

#include <cstddef>
#include <vector>

#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/triangle_tree.h"
#include "dem/vector.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// Distance that stands for "no contact".
inline constexpr double kEndless = 1e300;

/// The point of a surface nearest to a given point. In the wall's frame.
struct Closest {
  double distance = 0;             ///< m; negative inside a solid
  Vector normal = Vector::Zero();  ///< unit, from the surface to the point
};

/// Above a level face.
inline Closest closest_above(double level, const Vector& point) {
  return {.distance = point.z() - level, .normal = Vector::UnitZ()};
}

/// Inside a tube about the z axis, between its ends.
inline Closest closest_within(double inner_radius, double from_axis, const Vector& point) {
  const double inverse = 1 / from_axis;
  const Vector outwards =
      from_axis > 0 ? Vector(point.x() * inverse, point.y() * inverse, 0) : Vector::UnitX();
  return {.distance = inner_radius - from_axis, .normal = -outwards};
}

Closest closest(const Plane& plane, const Vector& point);
Closest closest(const Box& box, const Vector& point);
/// On the axis of the tube, where the direction is arbitrary, the normal is -x.
Closest closest(const Tube& tube, const Vector& point);

/// The spheres of a bed as a wall, one facet per sphere, represented by its nearest periodic image.
///
/// Valid for points within half a tile of a sphere; others never occur, since a tile is much wider
/// than what touches it. Proved by BedWall.* in tests/dem/bed_wall_test.cpp.
class BedFacets {
 public:
  /// Throws base::InputError for a bed without spheres, or with a sphere whose radius is not above
  /// 0 or not below a quarter of the tile.
  explicit BedFacets(const SphereBed& bed);

  /// Spheres within `distance` of a point, ascending.
  void near(const Vector& point, double distance, std::vector<int>& facets) const;

  /// The nearest point of one sphere; kEndless away beyond the ends of the bed. In the frame of the
  /// bed.
  Closest closest(int facet, const Vector& point) const;

  double curvature(int facet) const { return 1 / sphere(facet).radius; }
  double top() const { return top_; }  ///< highest point of all spheres, m

 private:
  const FixedSphere& sphere(int facet) const {
    return bed_.spheres[static_cast<std::size_t>(facet)];
  }
  /// From the nearest image of a sphere's centre.
  Vector from_centre(int facet, const Vector& point) const;
  int cell_of(double coordinate) const;
  std::size_t cell_at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_) +
           static_cast<std::size_t>(column);
  }

  SphereBed bed_;
  double top_ = 0;
  double widest_ = 0;  ///< radius
  int cells_ = 1;      ///< of a tile, both ways
  std::vector<std::vector<int>> spheres_in_;
};

/// The triangles of a mesh as a wall, with each edge and corner counted only once.
///
/// A sphere near a shared edge is nearest to both triangles at the same point. The contact then
/// belongs to the lowest-numbered of them, and only if neither is nearer with its face; likewise at
/// corners. A sphere in a fold touches two faces: those are two contacts. Proved by MeshWall.* in
/// tests/dem/mesh_wall_test.cpp.
class MeshFacets {
 public:
  /// Throws base::InputError for a mesh without triangles or with a degenerate one.
  explicit MeshFacets(const Mesh& mesh);
  ~MeshFacets() = default;
  MeshFacets(const MeshFacets&) = delete;  // the tree refers to mesh_
  MeshFacets& operator=(const MeshFacets&) = delete;

  /// Triangles whose bounds are within `distance` of a point along each axis, ascending.
  void near(const Vector& point, double distance, std::vector<int>& facets) const;

  /// The nearest point of one triangle if the contact there belongs to it, else kEndless away. In
  /// the frame of the mesh.
  Closest closest(int facet, const Vector& point) const;

 private:
  TrianglePoint nearest(int facet, const Vector& point) const;
  bool owns(int facet, const TrianglePoint& spot, const Vector& point) const;

  Mesh mesh_;  ///< coincident corners are merged
  TriangleTree tree_;
  std::vector<int>
      corner_start_;  ///< one more entry than corners: where each one's triangles start
  std::vector<int> corner_triangles_;  ///< ascending
};

}  // namespace repose::dem
