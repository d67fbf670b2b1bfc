#pragma once

#include <cstddef>
#include <vector>

#include "dem/wall/closest.h"

namespace repose::dem {

/// The spheres of a bed as walls, a facet each, whichever of its images is the nearest.
///
/// Holds for points within half a tile of a sphere: nobody asks about others, since a tile is much
/// wider than what touches it. Proved by BedWall.* in tests/dem/bed_wall_test.cpp.
class BedFacets {
 public:
  /// Throws base::InputError for a bed without spheres, with one without a radius or wider
  /// than its tile.
  explicit BedFacets(const SphereBed& bed);

  /// Spheres within `distance` of a point, in rising order.
  void near(const Vector& point, double distance, std::vector<int>& facets) const;

  /// The nearest point of one sphere; a distance without end where the bed has ended. In the frame
  /// of the bed.
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

}  // namespace repose::dem
