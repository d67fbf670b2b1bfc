#include "render/run/between.h"

namespace repose::render {
namespace {

using dem::Vector;

bool are_alike(const Scene& a, const Scene& b) {
  if (a.grains.size() != b.grains.size() || a.walls.size() != b.walls.size()) return false;
  for (std::size_t k = 0; k < a.grains.size(); ++k) {
    if (a.grains[k].number != b.grains[k].number) return false;
  }
  return true;
}

}  // namespace

Scene between(const Scene& a, const Scene& b, double part, double interval_s) {
  if (!are_alike(a, b)) return a;
  Scene scene = a;
  const double s = part, s2 = s * s, s3 = s2 * s;
  for (std::size_t k = 0; k < scene.grains.size(); ++k) {
    const PlacedGrain &from = a.grains[k], &to = b.grains[k];
    scene.grains[k].pose.position =
        (2 * s3 - 3 * s2 + 1) * from.pose.position + (3 * s2 - 2 * s3) * to.pose.position +
        interval_s * ((s3 - 2 * s2 + s) * from.velocity + (s3 - s2) * to.velocity);
    scene.grains[k].pose.orientation = from.pose.orientation.slerp(part, to.pose.orientation);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const dem::Pose &from = a.walls[k].pose, &to = b.walls[k].pose;
    scene.walls[k].pose.position = (1 - part) * from.position + part * to.position;
    scene.walls[k].pose.orientation = from.orientation.slerp(part, to.orientation);
  }
  return scene;
}

}  // namespace repose::render
