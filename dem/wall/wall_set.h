#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "dem/wall/facets.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// A point relative to one facet of a wall. World axes.
struct FacetContact {
  Vector normal = Vector::Zero();  ///< unit, from the wall to the point
  double distance = 0;             ///< m; kEndless if another facet has the contact
  double curvature = 0;            ///< of the facet, 1/m; 0: flat
};

/// All walls of a simulation, positioned at one time.
class WallSet {
 public:
  explicit WallSet(std::vector<Wall> walls);

  int size() const { return static_cast<int>(walls_.size()); }
  const Wall& wall(int index) const { return walls_[static_cast<std::size_t>(index)]; }
  const WallMoment& moment(int index) const { return moments_[static_cast<std::size_t>(index)]; }
  bool is_present(int index) const { return wall(index).is_present; }

  /// Whether a sphere can move from one of its facets to the next while staying in contact.
  bool has_facets(int index) const { return meshes_[static_cast<std::size_t>(index)] != nullptr; }

  void move_to(double time_s);
  /// From `time_s` on, which must be the time the walls are positioned at.
  void set_motions(int wall, std::vector<Motion> motions, double time_s);
  void remove(int wall) { walls_[static_cast<std::size_t>(wall)].is_present = false; }

  /// Greatest speed of any wall's points within a box, m/s, now or later as long as the pivots
  /// stay.
  double greatest_speed(double time_s, const Eigen::AlignedBox3d& within) const;

  /// Facets of a wall within `distance` of a point, ascending. Plain walls have one facet, 0.
  void facets_near(int wall, const Vector& point, double distance, std::vector<int>& facets) const;

  FacetContact contact(int wall, int facet, const Vector& point) const;

  /// Whether a sphere touches a facet of a wall, and where, as by contact(). Most spheres are above
  /// a level face or inside an upright tube, where a few comparisons suffice.
  bool touches(int wall, int facet, const Vector& centre, double radius,
               FacetContact& where) const {
    const Clearance& clear = clearances_[static_cast<std::size_t>(wall)];
    const Vector own = centre - clear.position;
    // Slightly more or less, as contact() rounds distances differently.
    if (own.z() < clear.from || own.z() > clear.to) {
      if (own.z() - clear.to > 1.000000000001 * radius) return false;
      if (own.z() > clear.to && std::abs(own.x()) <= clear.face_x &&
          std::abs(own.y()) <= clear.face_y) {
        where = flat(closest_above(clear.to, own));
        return where.distance < radius;
      }
    } else if (clear.bore > 0) {
      const double across2 = own.x() * own.x() + own.y() * own.y();
      const double gap = clear.bore - radius;
      if (gap > 0 && across2 < .999999999999 * (gap * gap)) return false;
      const double from_axis = std::sqrt(across2);
      if (from_axis <= clear.bore) {
        where = flat(closest_within(clear.bore, from_axis, own));
        return where.distance < radius;
      }
    }
    where = contact(wall, facet, centre);
    return where.distance < radius;
  }

 private:
  /// Where an upright wall has no material: above `to`, and between both heights within the bore.
  /// Default: nowhere.
  struct Clearance {
    Vector position = Vector::Zero();
    double from = -1e300;
    double to = 1e300;
    double bore = 0;
    double face_x = -1;  ///< half sides of the level face at `to`; below 0 if none
    double face_y = -1;
  };

  static FacetContact flat(const Closest& spot) {
    return {.normal = spot.normal, .distance = spot.distance};
  }

  Clearance clearance(std::size_t wall) const;
  Vector in_frame_of(std::size_t wall, const Vector& point) const;

  std::vector<Wall> walls_;
  std::vector<WallMoment> moments_;
  std::vector<Eigen::Matrix3d> axes_;
  std::vector<Clearance> clearances_;
  std::vector<char> is_turned_;  ///< whether the axes differ from the world's
  std::vector<char> is_placed_;  ///< permanently, as it has no motions
  std::vector<std::shared_ptr<const MeshFacets>> meshes_;  ///< null for other walls
  std::vector<std::shared_ptr<const BedFacets>> beds_;     ///< likewise
};

}  // namespace repose::dem
