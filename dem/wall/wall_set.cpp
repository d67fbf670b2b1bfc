#include "dem/wall/wall_set.h"

#include <algorithm>
#include <utility>
namespace repose::dem {

WallSet::WallSet(std::vector<Wall> walls)
    : walls_(std::move(walls)),
      moments_(walls_.size()),
      axes_(walls_.size()),
      clearances_(walls_.size()),
      is_turned_(walls_.size()),
      is_placed_(walls_.size()),
      meshes_(walls_.size()),
      beds_(walls_.size()) {
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (const auto* surface = std::get_if<MeshSurface>(&walls_[k].shape)) {
      meshes_[k] = std::make_shared<const MeshFacets>(surface->mesh);
    }
    if (const auto* bed = std::get_if<SphereBed>(&walls_[k].shape)) {
      beds_[k] = std::make_shared<const BedFacets>(*bed);
    }
  }
  move_to(0);
}

void WallSet::move_to(double time_s) {
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (is_placed_[k] != 0) continue;
    is_placed_[k] = walls_[k].motions.empty() ? 1 : 0;
    moments_[k] = wall_at(walls_[k], time_s);
    axes_[k] = moments_[k].pose.orientation.toRotationMatrix();
    is_turned_[k] = axes_[k] != Eigen::Matrix3d::Identity() ? 1 : 0;
    clearances_[k] = clearance(k);
  }
}

WallSet::Clearance WallSet::clearance(std::size_t wall) const {
  Clearance clear{.position = moments_[wall].pose.position};
  if (is_turned_[wall] != 0) return clear;
  if (std::holds_alternative<Plane>(walls_[wall].shape)) {
    clear.from = clear.to = 0;
    clear.face_x = clear.face_y = 1e300;
  } else if (const auto* box = std::get_if<Box>(&walls_[wall].shape)) {
    clear.from = clear.to = box->half_size.z();
    clear.face_x = box->half_size.x();
    clear.face_y = box->half_size.y();
  } else if (const auto* tube = std::get_if<Tube>(&walls_[wall].shape)) {
    clear.from = 0;
    clear.to = tube->height;
    clear.bore = tube->inner_radius;
  } else if (beds_[wall]) {
    clear.from = clear.to = beds_[wall]->top();
  }
  return clear;
}

void WallSet::set_motions(int wall, std::vector<Motion> motions, double time_s) {
  const auto k = static_cast<std::size_t>(wall);
  walls_[k].pose = moments_[k].pose;
  for (Motion& motion : motions) motion.start_s = std::max(motion.start_s, time_s);
  walls_[k].motions = std::move(motions);
  is_placed_[k] = 0;
}

double WallSet::greatest_speed(double time_s, const Eigen::AlignedBox3d& within) const {
  double greatest = 0;
  if (within.isEmpty()) return greatest;
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (!walls_[k].is_present) continue;
    for (const Motion& motion : walls_[k].motions) {
      if (time_s >= motion.stop_s) continue;
      const Vector pivot = motion.pivot + std::max(0.0, time_s - motion.start_s) * motion.velocity;
      // Convex in position: the maximum is at a corner.
      for (int corner = 0; corner < 8; ++corner) {
        const Vector arm =
            within.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - pivot;
        greatest = std::max(greatest, motion.velocity.norm() + motion.spin.cross(arm).norm());
      }
    }
  }
  return greatest;
}

void WallSet::facets_near(int wall, const Vector& point, double distance,
                          std::vector<int>& facets) const {
  const auto k = static_cast<std::size_t>(wall);
  if (meshes_[k]) {
    meshes_[k]->near(in_frame_of(k, point), distance, facets);
    return;
  }
  if (beds_[k]) {
    beds_[k]->near(in_frame_of(k, point), distance, facets);
    return;
  }
  facets.clear();
  if (contact(wall, 0, point).distance < distance) facets.push_back(0);
}

FacetContact WallSet::contact(int wall, int facet, const Vector& point) const {
  const auto k = static_cast<std::size_t>(wall);
  const Vector own = in_frame_of(k, point);
  const Closest spot = std::visit(
      [&](const auto& shape) -> Closest {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, MeshSurface>) {
          return meshes_[k]->closest(facet, own);
        } else if constexpr (std::is_same_v<Shape, SphereBed>) {
          return beds_[k]->closest(facet, own);
        } else {
          return closest(shape, own);
        }
      },
      walls_[k].shape);
  const double curvature = beds_[k] ? beds_[k]->curvature(facet) : 0;
  if (!is_turned_[k]) {
    return {.normal = spot.normal, .distance = spot.distance, .curvature = curvature};
  }
  return {.normal = axes_[k] * spot.normal, .distance = spot.distance, .curvature = curvature};
}

Vector WallSet::in_frame_of(std::size_t wall, const Vector& point) const {
  const Vector shifted = point - moments_[wall].pose.position;
  if (!is_turned_[wall]) return shifted;
  return axes_[wall].transpose() * shifted;
}

}  // namespace repose::dem
