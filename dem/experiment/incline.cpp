#include "dem/experiment/incline.h"

#include <numbers>

#include "dem/experiment/placing.h"
#include "dem/experiment/random.h"

namespace repose::dem {

Incline incline_of(const RollProtocol& protocol) {
  const double angle = protocol.incline_deg * std::numbers::pi / 180;
  Incline slope{.orientation = Quaternion(Eigen::AngleAxisd(angle, Vector::UnitY()))};
  slope.down = slope.orientation * Vector::UnitX();
  slope.normal = slope.orientation * Vector::UnitZ();
  return slope;
}

Grain released(const ClumpShape& shape, const RollProtocol& protocol, std::uint64_t seed) {
  const Incline slope = incline_of(protocol);
  Random random(seed);
  const double about_normal = 2 * std::numbers::pi * random.uniform();
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
