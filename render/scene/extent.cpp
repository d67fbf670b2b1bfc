#include "render/scene/extent.h"

#include <algorithm>
#include <cmath>

namespace repose::render {

namespace {

/// Largest sine of the slope of a level wall face.
constexpr double kLevel = 1e-6;

/// Height of a wall's upper face, if it is level.
std::optional<double> level_face_m(const PlacedWall& wall) {
  const Eigen::Matrix3d axes = wall.pose.orientation.toRotationMatrix();
  if (std::holds_alternative<dem::Plane>(wall.shape)) {
    if (std::hypot(axes(0, 2), axes(1, 2)) > kLevel || axes(2, 2) < 0) return std::nullopt;
    return wall.pose.position.z();
  }
  if (const auto* box = std::get_if<dem::Box>(&wall.shape)) {
    for (int k = 0; k < 3; ++k) {
      if (std::hypot(axes(0, k), axes(1, k)) > kLevel) continue;
      return wall.pose.position.z() + box->half_size[k];
    }
  }
  return std::nullopt;
}

const dem::ClumpShape& shape_of(const Scene& scene, const PlacedGrain& grain) {
  return scene.shapes[static_cast<std::size_t>(grain.shape)];
}

/// Extends the bounds along one axis to include the rotated surface.
void extend_along(Eigen::AlignedBox3d& bounds, int axis, double middle_m,
                  const Eigen::RowVector3d& direction, const dem::Mesh& surface) {
  double low = bounds.min()[axis];
  double high = bounds.max()[axis];
  for (const dem::Vector& vertex : surface.vertices) {
    const double along = middle_m + direction.dot(vertex);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  bounds.min()[axis] = low;
  bounds.max()[axis] = high;
}

}  // namespace

Eigen::AlignedBox3d grain_bounds(const Scene& scene, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox3d bounds;
  if (scene.setting) {
    for (int k = 0; k < 8; ++k) {
      const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(k);
      bounds.extend(axes * scene.setting->extent.corner(corner));
    }
    return bounds;
  }
  // Spheres first: all but a few surfaces lie inside their bounds and need not be rotated.
  for (const PlacedGrain& grain : scene.grains) {
    const dem::Vector middle = axes * grain.pose.position;
    const Eigen::Matrix3d turn = axes * grain.pose.orientation.toRotationMatrix();
    for (const dem::ClumpSphere& sphere : shape_of(scene, grain).spheres) {
      const dem::Vector centre = middle + turn * sphere.centre;
      bounds.extend((centre.array() - sphere.radius).matrix());
      bounds.extend((centre.array() + sphere.radius).matrix());
    }
  }
  const std::vector<double> reaches_m = reaches_of(scene);
  for (const PlacedGrain& grain : scene.grains) {
    const dem::Vector middle = axes * grain.pose.position;
    const double reach_m = reaches_m[static_cast<std::size_t>(grain.shape)];
    const Eigen::Matrix3d turn = axes * grain.pose.orientation.toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      if (middle[k] - reach_m >= bounds.min()[k] && middle[k] + reach_m <= bounds.max()[k])
        continue;
      extend_along(bounds, k, middle[k], turn.row(k), shape_of(scene, grain).surface);
    }
  }
  return bounds;
}

std::optional<double> ground_m(const Scene& scene) {
  if (scene.grains.empty()) return std::nullopt;
  double middle_m = 0;
  for (const PlacedGrain& grain : scene.grains) middle_m += grain.pose.position.z();
  middle_m /= static_cast<double>(scene.grains.size());
  std::optional<double> ground;
  for (const PlacedWall& wall : scene.walls) {
    const auto face = level_face_m(wall);
    if (face && *face < middle_m) ground = std::max(ground.value_or(*face), *face);
  }
  return ground;
}

namespace {

using dem::Vector;

/// The point of a straight line in space that is seen in column `x`; columns increase along the
/// line.
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
  Vector right = view.axes.row(0);  // includes the camera's roll
  const Vector into = view.axes.row(2);
  right = into.cross(Vector::UnitZ());
  if (right.norm() < 1e-9) return std::nullopt;  // the camera looks straight down
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
