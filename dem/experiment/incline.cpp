#include "dem/experiment/incline.h"

#include <numbers>

#include "dem/experiment/placing.h"

namespace repose::dem {

Incline incline_of(const RollProtocol& protocol) {
  const double angle = protocol.incline_deg * std::numbers::pi / 180;
  Incline slope{.orientation = Quaternion(Eigen::AngleAxisd(angle, Vector::UnitY()))};
  slope.down = slope.orientation * Vector::UnitX();
  slope.normal = slope.orientation * Vector::UnitZ();
  return slope;
}

Grain released(const ClumpShape& shape, const RollProtocol& protocol, Random& random) {
  const Incline slope = incline_of(protocol);
  const double turn = protocol.release_turn_deg * std::numbers::pi / 180;
  const double which_end = random.uniform() < .5 ? 0 : std::numbers::pi;
  const double about_normal = which_end + random.between(-turn, turn);
  const double about_long_axis = 2 * std::numbers::pi * random.uniform();
  Grain grain;
  grain.orientation =
      slope.orientation * Quaternion(Eigen::AngleAxisd(about_normal, Vector::UnitZ())) *
      Quaternion(Eigen::AngleAxisd(about_long_axis, Vector::UnitY())) * lying_pose(shape);
  grain.position = -protocol.release_m * slope.down +
                   reach_towards(shape, grain.orientation, -slope.normal) * slope.normal;
  return grain;
}

}  // namespace repose::dem
