#pragma once

#include "dem/vector.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// The distance of what is nowhere near.
inline constexpr double kEndless = 1e300;

/// The nearest spot of a surface, seen from a point. In the wall's frame.
struct Closest {
  double distance = 0;             ///< m; negative inside a solid
  Vector normal = Vector::Zero();  ///< unit, from the surface to the point
};

/// Over a level face.
inline Closest closest_above(double level, const Vector& point) {
  return {.distance = point.z() - level, .normal = Vector::UnitZ()};
}

/// Within a tube, whose axis is z, between its ends.
inline Closest closest_within(double inner_radius, double from_axis, const Vector& point) {
  const double inverse = 1 / from_axis;
  const Vector outwards =
      from_axis > 0 ? Vector(point.x() * inverse, point.y() * inverse, 0) : Vector::UnitX();
  return {.distance = inner_radius - from_axis, .normal = -outwards};
}

Closest closest(const Plane& plane, const Vector& point);
Closest closest(const Box& box, const Vector& point);
/// On the axis of the tube, where all directions are alike, the normal is -x.
Closest closest(const Tube& tube, const Vector& point);

}  // namespace repose::dem
