#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/triangle_tree.h"

namespace repose::dem {

/// Distances from a watertight surface. The mesh must outlive it.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Mesh& mesh);

  /// Negative inside. The sign comes from the normal at the nearest point; corners use the
  /// angle-weighted normal, edges the sum of both faces' normals. Source: Baerentzen & Aanaes,
  /// Signed distance computation using the angle weighted pseudonormal, IEEE Trans. Vis. Comput.
  /// Graph. 11 (2005) 243-253.
  double signed_distance(const Vector& point) const;

 private:
  Vector normal_at(const TriangleTree::Nearest& nearest) const;

  const Mesh& mesh_;
  TriangleTree tree_;
  std::vector<Vector> face_normals_;
  std::vector<Vector> corner_normals_;
  std::vector<std::array<Vector, 3>> edge_normals_;  ///< by triangle and side
};

struct SurfaceSample {
  Vector point = Vector::Zero();
  Vector normal = Vector::Zero();  ///< outwards, unit
};

/// Points spread evenly over a surface, each representing the same area; deterministic.
std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count);

struct WeightedPoint {
  Vector point = Vector::Zero();
  double area = 0;
};

/// About `count` points spread evenly over the exposed surface of a union of spheres.
std::vector<WeightedPoint> sample_union(std::span<const ClumpSphere> spheres, std::size_t count);

/// The part of a line parallel to z that is inside a body.
struct Chord {
  double from = 0;
  double to = 0;
};
using Chords = std::vector<Chord>;  ///< ascending, disjoint

/// Lines parallel to z on a square grid, each representing the same area. Lengths along them are
/// exact.
class ColumnGrid {
 public:
  /// About `across` columns along the longer of the bounds' x and y sides.
  ColumnGrid(const Eigen::AlignedBox3d& bounds, int across);

  /// For each column, the part inside a watertight surface.
  std::vector<Chords> of_surface(const Mesh& mesh) const;
  /// For each column, the part inside at least one of the spheres.
  std::vector<Chords> of_union(std::span<const ClumpSphere> spheres) const;

  /// Volume, centroid and second moments of the body that the chords belong to.
  MassProperties mass_properties(const std::vector<Chords>& columns) const;
  /// Volume that is in only one of the two bodies, m^3.
  double mismatch_m3(const std::vector<Chords>& a, const std::vector<Chords>& b) const;
  /// Points inside the body, one per cube of the grid's spacing.
  std::vector<Vector> points_inside(const std::vector<Chords>& columns) const;

  double spacing_m() const { return spacing_; }

 private:
  struct Place {
    double x, y;
  };
  Place place(std::size_t column) const;
  std::size_t size() const { return index(columns_y_, 0); }
  std::size_t index(int row, int i) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_x_) +
           static_cast<std::size_t>(i);
  }
  /// Columns within from ... to, clipped to the grid; `low` is the grid's edge.
  struct Range {
    int from, to;
  };
  Range range(double from, double to, double low, int count) const;

  Vector low_;
  double spacing_ = 0;
  int columns_x_ = 0;
  int columns_y_ = 0;
};

}  // namespace repose::dem
