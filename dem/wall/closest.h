#pragma once

#include "dem/vector.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// The nearest spot of a surface, seen from a point. In the wall's frame.
struct Closest {
  double distance = 0;             ///< m; negative inside a solid
  Vector normal = Vector::Zero();  ///< unit, from the surface to the point
};

Closest closest(const Plane& plane, const Vector& point);
Closest closest(const Box& box, const Vector& point);
/// On the axis of the tube, where all directions are alike, the normal is -x.
Closest closest(const Tube& tube, const Vector& point);

}  // namespace repose::dem
