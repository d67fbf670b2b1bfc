#include "dem/experiment/tilting_plate.h"

namespace repose::dem {

Quaternion slope(double angle_deg) {
  return Quaternion(Eigen::AngleAxisd(angle_deg * kDegree, Vector::UnitY()));
}

Vector on_plate(const Simulation& simulation, int wall, int grain) {
  return simulation.wall(wall).pose.orientation.conjugate() * simulation.grain(grain).position;
}

Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain) {
  return simulation.wall(wall).pose.orientation.conjugate() * simulation.grain(grain).orientation;
}

}  // namespace repose::dem
