#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"
#include "dem/vector.h"
#include "dem/wall/wall.h"

namespace repose::render {

/// Triangles to draw, with a normal at each vertex.
struct Surface {
  static constexpr std::size_t kFloats = 6;  ///< per vertex

  std::vector<float> vertices;  ///< x y z, m, and the unit normal
  std::vector<std::uint32_t> corners;

  std::size_t triangles() const { return corners.size() / 3; }
};

/// A grain's surface with as few triangles as the tolerance allows, and the smooth normals of the
/// full mesh. Edges are collapsed in the order of their quadric error (Garland & Heckbert, Surface
/// simplification using quadric error metrics, SIGGRAPH 1997); then the area is restored. Proved by
/// Surface.* in tests/render/surface_test.cpp.
Surface grain_surface(const dem::Mesh& mesh, double tolerance_m);

/// Spheres as polyhedra whose silhouettes are within the tolerance of the circles and enclose, on
/// average, the same area. Triangles wholly inside another sphere are left out.
Surface sphere_surface(const std::vector<dem::ClumpSphere>& spheres, double tolerance_m);

/// A wall; a plane becomes a slab of the given size. No edge is longer than `edge_m`, so that lens
/// distortion can bend it.
Surface wall_surface(const dem::WallShape& shape, const dem::Vector& slab_middle,
                     double slab_half_m, double edge_m);

}  // namespace repose::render
