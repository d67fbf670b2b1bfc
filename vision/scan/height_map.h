#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "vision/scan/ground_plane.h"

namespace repose::vision {

/// Coordinate axes on the ground: `u` and `v` lie in it, heights are above it.
struct ScanFrame {
  Eigen::Vector3d origin, u, v, up;

  /// @param middle  a point near the heap; the origin is below it
  ScanFrame(const GroundPlane& plane, const Eigen::Vector3d& middle);
  Eigen::Vector3d inside(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d from = place - origin;
    return {from.dot(u), from.dot(v), from.dot(up)};
  }
  Eigen::Vector3d outside(const Eigen::Vector3d& place) const {
    return origin + place.x() * u + place.y() * v + place.z() * up;
  }
};

/// A square grid of square cells on the ground.
struct MapPlan {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  double cell = 1;
  int side = 1;  ///< cells
};

enum class CellKind : std::uint8_t {
  outside,  ///< nothing was seen here, nor farther out
  seen,
  hole,  ///< nothing was seen here, but all around
};

/// Heights above the ground: each cell's is the mean over its ninths, each the mean of its points,
/// so that a steep side seen from many stands has no more weight than its plan area. Stray points
/// far from the cell's median (four robust standard deviations) are excluded. The plain median was
/// up to 2 % of the volume too high or too low, depending on whether scanners looked from above or
/// from the side.
struct HeightMap {
  MapPlan plan;
  std::vector<float> height;  ///< row by row, v ascending
  std::vector<CellKind> kind;
  std::vector<std::uint32_t> points;  ///< in each cell

  int side() const { return plan.side; }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side()) +
           static_cast<std::size_t>(x);
  }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < side() && y < side(); }
  Eigen::Vector2d middle(int x, int y) const {
    return plan.corner + plan.cell * Eigen::Vector2d(x + .5, y + .5);
  }
  Eigen::Vector2d middle(std::size_t cell) const {
    const auto across = static_cast<std::size_t>(side());
    return middle(static_cast<int>(cell % across), static_cast<int>(cell / across));
  }
  /// NaN if a neighbouring cell is outside.
  double height_at(const Eigen::Vector2d& place) const;
  /// The cell that contains a place; the number of cells if none does.
  std::size_t cell_of(const Eigen::Vector2d& place) const;
};

enum class Points { all, even, odd };  ///< the two halves are selected by a hash of their indices

/// Cells count as seen if they have points, or if most of their neighbours do; cells enclosed by
/// seen ones are holes, filled so that each is the mean of its four neighbours.
/// @param lowest  points below it belong neither to the ground nor to the heap, and a cell with
/// more
///   of them than of others counts as not seen: a floor beside the table
HeightMap height_map(const std::vector<Eigen::Vector3d>& points, const ScanFrame& frame,
                     const MapPlan& plan, double lowest, Points which = Points::all);

/// Moving average over (2 reach + 1)^2 cells.
std::vector<float> smoothed(const HeightMap& map, int reach);

/// A connected part of a map, including diagonal neighbours.
struct Region {
  std::vector<std::size_t> cells;
  double volume = 0;   ///< of the heap above it
  double highest = 0;  ///< the height that one in a hundred of its cells exceeds
  double cut = 0;      ///< fraction of its rim with nothing seen beyond it
};

/// The parts of the map above a threshold, largest volume first; those with fewer than `fewest`
/// cells are left out.
std::vector<Region> regions_above(const HeightMap& map, double threshold, std::size_t fewest);

/// 1 in the cells of the region and in those enclosed by it.
std::vector<std::uint8_t> mask_of(const HeightMap& map, const Region& region);

/// Adds all cells with centres within `reach` cells of the mask's.
std::vector<std::uint8_t> dilated(const HeightMap& map, const std::vector<std::uint8_t>& mask,
                                  int reach);

}  // namespace repose::vision
