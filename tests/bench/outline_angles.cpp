#include "tests/bench/outline_angles.h"

#include <stdexcept>

#include "vision/measure/geometry.h"
#include "vision/measure/outline_angle.h"

namespace repose::bench {

FlankAngles outline_angles(const render::Truth& truth, double grain_px) {
  const auto& [from, to] = truth.ground.value();
  const double slope = (to.y - from.y) / (to.x - from.x);
  const vision::GroundFrame ground({.y_at_0 = from.y - slope * from.x, .slope = slope});
  vision::Outline outline;
  for (const vision::Point& point : truth.outline) {
    outline.along.push_back(ground.along(point));
    outline.height.push_back(ground.height(point));
  }
  const vision::OutlineAngle angle = vision::measure_outline(outline, {.grain = grain_px});
  if (!angle.left || !angle.right) throw std::logic_error("a heap without a flank");
  return {.left_rad = angle.left->angle_rad, .right_rad = angle.right->angle_rad};
}

}  // namespace repose::bench
