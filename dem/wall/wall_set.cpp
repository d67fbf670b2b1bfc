#include "dem/wall/wall_set.h"

#include <algorithm>
#include <utility>

#include "dem/wall/closest.h"

namespace repose::dem {

WallSet::WallSet(std::vector<Wall> walls)
    : walls_(std::move(walls)),
      moments_(walls_.size()),
      present_(walls_.size(), true),
      axes_(walls_.size()) {
  move_to(0);
}

void WallSet::move_to(double time_s) {
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    moments_[k] = wall_at(walls_[k], time_s);
    axes_[k] = moments_[k].pose.orientation.toRotationMatrix();
  }
}

void WallSet::set_motions(int wall, std::vector<Motion> motions) {
  const auto k = static_cast<std::size_t>(wall);
  walls_[k].pose = moments_[k].pose;
  walls_[k].motions = std::move(motions);
}

double WallSet::greatest_speed(double time_s, double reach) const {
  double greatest = 0;
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    if (!present_[k]) continue;
    for (const Motion& motion : walls_[k].motions) {
      if (time_s >= motion.stop_s) continue;
      greatest = std::max(
          greatest, motion.velocity.norm() + motion.spin.norm() * (reach + motion.pivot.norm()));
    }
  }
  return greatest;
}

void WallSet::facets_near(int wall, const Vector& point, double distance,
                          std::vector<int>& facets) const {
  facets.clear();
  if (contact(wall, 0, point).distance < distance) facets.push_back(0);
}

FacetContact WallSet::contact(int wall, int /*facet*/, const Vector& point) const {
  const auto k = static_cast<std::size_t>(wall);
  const Vector own = axes_[k].transpose() * (point - moments_[k].pose.position);
  const Closest spot = std::visit(
      [&own](const auto& shape) -> Closest {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, MeshSurface>) {
          return {.distance = 1e300, .normal = Vector::UnitZ()};
        } else {
          return closest(shape, own);
        }
      },
      walls_[k].shape);
  return {.distance = spot.distance, .normal = axes_[k] * spot.normal};
}

}  // namespace repose::dem
