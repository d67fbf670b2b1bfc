#include "render/scene/ground.h"

#include <algorithm>
#include <cmath>

#include "render/scene/extent.h"

namespace repose::render {
namespace {

using dem::Vector;

/// The point of a straight line in space that is seen in column `x`; columns rise along the line.
std::optional<vision::Point> at_column(const View& view, const Vector& middle, const Vector& way,
                                       double reach_m, double x) {
  double low = -reach_m, high = reach_m;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double half = .5 * (low + high);
    const auto point = view.project(middle + half * way);
    if (!point) return std::nullopt;
    (point->x < x ? low : high) = half;
  }
  return view.project(middle + .5 * (low + high) * way);
}

}  // namespace

std::optional<vision::Segment> ground_in_picture(const Scene& scene, const View& view) {
  const auto ground = ground_m(scene);
  if (!ground) return std::nullopt;
  Vector middle = grain_bounds(scene, Eigen::Matrix3d::Identity()).center();
  middle.z() = *ground;
  Vector right = view.axes.row(0);  // turned by the camera's roll
  const Vector into = view.axes.row(2);
  right = into.cross(Vector::UnitZ());
  if (right.norm() < 1e-9) return std::nullopt;  // looks straight down
  right.normalize();
  const double width_m =
      view.size.width / view.scale * (view.is_perspective ? view.in_camera(middle).z() : 1.0);
  constexpr double kReach = 4;  // lines far outside still cross the picture's edges
  const auto left_end = at_column(view, middle, right, kReach * width_m, 0);
  const auto right_end = at_column(view, middle, right, kReach * width_m, view.size.width);
  if (!left_end || !right_end) return std::nullopt;
  return vision::Segment{*left_end, *right_end};
}

}  // namespace repose::render
