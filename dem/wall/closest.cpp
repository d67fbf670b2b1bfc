#include "dem/wall/closest.h"

#include <algorithm>
#include <cmath>

namespace repose::dem {
namespace {

/// Of a rectangle (`half` its half sides) about the origin, any number of dimensions.
template <typename Point>
struct Nearest {
  double distance;
  Point normal;
};

template <typename Point>
Nearest<Point> nearest_on_box(const Point& half, const Point& point) {
  const Point outside = point - point.cwiseMax(-half).cwiseMin(half);
  const double distance = outside.norm();
  if (distance > 0) return {distance, outside / distance};
  // Within: the nearest face; of equally near ones the first.
  const Point depth = half - point.cwiseAbs();
  Eigen::Index axis = 0;
  const double least = depth.minCoeff(&axis);
  Point normal = Point::Zero();
  normal[axis] = point[axis] < 0 ? -1 : 1;
  return {-least, normal};
}

}  // namespace

Closest closest(const Plane& /*plane*/, const Vector& point) { return closest_above(0, point); }

Closest closest(const Box& box, const Vector& point) {
  const Vector& half = box.half_size;
  if (point.z() > half.z() && std::abs(point.x()) <= half.x() && std::abs(point.y()) <= half.y()) {
    return closest_above(half.z(), point);
  }
  const auto [distance, normal] = nearest_on_box<Vector>(half, point);
  return {.distance = distance, .normal = normal};
}

Closest closest(const Tube& tube, const Vector& point) {
  using Point = Eigen::Vector2d;
  const double from_axis = std::sqrt(point.x() * point.x() + point.y() * point.y());
  const Closest within = closest_within(tube.inner_radius, from_axis, point);
  if (from_axis <= tube.inner_radius && point.z() >= 0 && point.z() <= tube.height) return within;
  const Point half(tube.thickness / 2, tube.height / 2);
  const Point middle(tube.inner_radius + half.x(), half.y());
  const auto [distance, normal] = nearest_on_box<Point>(half, Point(from_axis, point.z()) - middle);
  const Vector outwards = -within.normal;
  return {.distance = distance, .normal = normal.x() * outwards + normal.y() * Vector::UnitZ()};
}

}  // namespace repose::dem
