#pragma once

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "dem/wall/bed_facets.h"
#include "dem/wall/mesh_facets.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// Where a point is against one facet of a wall. World axes.
struct FacetContact {
  Vector normal = Vector::Zero();  ///< unit, from the wall to the point
  double distance = 0;             ///< m; without end when another facet has the contact
  double curvature = 0;            ///< of the facet, 1/m; 0: flat
};

/// All walls of a simulation, placed for one moment.
class WallSet {
 public:
  explicit WallSet(std::vector<Wall> walls);

  int size() const { return static_cast<int>(walls_.size()); }
  const Wall& wall(int index) const { return walls_[static_cast<std::size_t>(index)]; }
  const WallMoment& moment(int index) const { return moments_[static_cast<std::size_t>(index)]; }
  bool is_present(int index) const { return wall(index).is_present; }

  /// Whether a sphere can move from one of its facets to the next and still be in touch.
  bool has_facets(int index) const { return meshes_[static_cast<std::size_t>(index)] != nullptr; }

  void move_to(double time_s);
  /// From `time_s` on, the moment that the walls are placed for.
  void set_motions(int wall, std::vector<Motion> motions, double time_s);
  void remove(int wall) { walls_[static_cast<std::size_t>(wall)].is_present = false; }

  /// Greatest speed of any wall's points within a box, now or later as long as its pivots stay,
  /// m/s.
  double greatest_speed(double time_s, const Eigen::AlignedBox3d& within) const;

  /// Facets of a wall within `distance` of a point, in rising order. Plain walls are one facet, 0.
  void facets_near(int wall, const Vector& point, double distance, std::vector<int>& facets) const;

  FacetContact contact(int wall, int facet, const Vector& point) const;

  /// True for most spheres that touch no facet of a wall, at the cost of a few comparisons; never
  /// for one that does.
  bool is_clear(int wall, const Vector& centre, double radius) const {
    const Clearance& clear = clearances_[static_cast<std::size_t>(wall)];
    const double height = centre.z() - clear.position.z();
    // A little more, and less: distances are rounded on another way.
    if (height < clear.from || height > clear.to) {
      return height - clear.to > 1.000000000001 * radius;
    }
    const double gap = clear.bore - radius;
    const double x = centre.x() - clear.position.x();
    const double y = centre.y() - clear.position.y();
    return gap > 0 && x * x + y * y < .999999999999 * (gap * gap);
  }

 private:
  /// Where nothing of an upright wall is: above `to`, and between both heights within the bore. As
  /// it is at first, nowhere.
  struct Clearance {
    Vector position = Vector::Zero();
    double from = -1e300;
    double to = 1e300;
    double bore = 0;
  };

  Clearance clearance(std::size_t wall) const;
  Vector in_frame_of(std::size_t wall, const Vector& point) const;

  std::vector<Wall> walls_;
  std::vector<WallMoment> moments_;
  std::vector<Eigen::Matrix3d> axes_;
  std::vector<Clearance> clearances_;
  std::vector<char> is_turned_;  ///< whether the axes are others than the world's
  std::vector<char> is_placed_;  ///< for good: it has no motions
  std::vector<std::shared_ptr<const MeshFacets>> meshes_;  ///< empty for other walls
  std::vector<std::shared_ptr<const BedFacets>> beds_;     ///< likewise
};

}  // namespace repose::dem
