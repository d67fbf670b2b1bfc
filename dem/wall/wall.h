#pragma once

#include <variant>
#include <vector>

#include "dem/shape/scan/mesh.h"
#include "dem/vector.h"

namespace repose::dem {

/// A wall's position and orientation.
struct Pose {
  Vector position = Vector::Zero();
  Quaternion orientation = Quaternion::Identity();
};

/// z = 0 of the wall's frame, solid below, without end.
struct Plane {};

/// A solid box, centred on the origin of the wall's frame.
struct Box {
  Vector half_size = Vector::Zero();  ///< m
};

/// A tube about the z axis of the wall's frame, from z = 0 to `height`, open at both ends.
struct Tube {
  double inner_radius = 0;  ///< m
  double thickness = 0;     ///< m, outwards
  double height = 0;        ///< m
};

/// Triangles of any kind, touched from both sides.
struct MeshSurface {
  Mesh mesh;
};

struct FixedSphere {
  Vector centre = Vector::Zero();  ///< m
  double radius = 0;               ///< m
};

/// Spheres fixed to each other, touched from outside: a tile of them that repeats itself without
/// end along x and y of the wall's frame, as far as `from_x` and `to_x` allow.
struct SphereBed {
  std::vector<FixedSphere> spheres;
  double tile = 0;  ///< m, both ways; much wider than what touches it
  /// Spheres whose centres lie outside are left out, m.
  double from_x = -1e9;
  double to_x = 1e9;
};

using WallShape = std::variant<Plane, Box, Tube, MeshSurface, SphereBed>;

/// Moves at a steady rate from `start_s` to `stop_s`, and stands still before and after.
struct Motion {
  Vector velocity = Vector::Zero();  ///< m/s
  Vector spin = Vector::Zero();      ///< rad/s, about `pivot`
  Vector pivot = Vector::Zero();     ///< world point that the spin turns about; moves along
  double start_s = 0;
  double stop_s = 1e300;
};

/// A wall as set up: what it is, where it is at time 0 and how it moves.
struct Wall {
  WallShape shape = Plane{};
  int material = 0;
  Pose pose = {};
  std::vector<Motion> motions = {};  ///< stretches in time that do not overlap
  bool is_present = true;            ///< a wall that was taken out keeps its number
};

/// Where a wall is at one time, and how its points move.
struct WallMoment {
  Pose pose;
  Vector velocity = Vector::Zero();  ///< of `pivot`
  Vector spin = Vector::Zero();
  Vector pivot = Vector::Zero();

  Vector velocity_at(const Vector& point) const { return velocity + spin.cross(point - pivot); }
};

WallMoment wall_at(const Wall& wall, double time_s);

}  // namespace repose::dem
