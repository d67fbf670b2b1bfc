#include "dem/wall/wall.h"

#include <algorithm>

namespace repose::dem {

WallMoment wall_at(const Wall& wall, double time_s) {
  WallMoment now{.pose = wall.pose};
  for (const Motion& motion : wall.motions) {
    const double moved_s = std::clamp(time_s, motion.start_s, motion.stop_s) - motion.start_s;
    if (moved_s < 0) continue;
    const Vector shift = moved_s * motion.velocity;
    const double angle = moved_s * motion.spin.norm();
    if (angle > 0) {
      const Quaternion turn(Eigen::AngleAxisd(angle, motion.spin.normalized()));
      now.pose.position = motion.pivot + turn * (now.pose.position - motion.pivot);
      now.pose.orientation = (turn * now.pose.orientation).normalized();
    }
    now.pose.position += shift;
    if (time_s >= motion.start_s && time_s < motion.stop_s) {
      now.velocity = motion.velocity;
      now.spin = motion.spin;
      now.pivot = motion.pivot + shift;
    }
  }
  return now;
}

}  // namespace repose::dem
