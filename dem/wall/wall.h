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

/// The plane z = 0 of the wall's frame, solid below, infinite.
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

/// Any triangles, touched from both sides.
struct MeshSurface {
  Mesh mesh;
};

struct FixedSphere {
  Vector centre = Vector::Zero();  ///< m
  double radius = 0;               ///< m
};

/// Spheres fixed to each other, touched from outside: a tile repeated endlessly along x and y of
/// the wall's frame, within `from_x` and `to_x`.
struct SphereBed {
  std::vector<FixedSphere> spheres;
  double tile = 0;  ///< m, along x and y; much wider than what touches it
  /// Spheres whose centres lie outside are left out, m.
  double from_x = -1e9;
  double to_x = 1e9;
};

using WallShape = std::variant<Plane, Box, Tube, MeshSurface, SphereBed>;

/// Steady motion from `start_s` to `stop_s`, at rest before and after.
struct Motion {
  Vector velocity = Vector::Zero();  ///< m/s
  Vector spin = Vector::Zero();      ///< rad/s, about `pivot`
  Vector pivot = Vector::Zero();     ///< world point on the axis of rotation; moves along
  double start_s = 0;
  double stop_s = 1e300;
};

/// A wall as set up: its shape, where it is at time 0 and how it moves.
struct Wall {
  WallShape shape = Plane{};
  int material = 0;
  Pose pose = {};
  std::vector<Motion> motions = {};  ///< must not overlap in time
  bool is_present = true;            ///< a removed wall keeps its number
};

/// Position and motion of a wall at one time.
struct WallMoment {
  Pose pose;
  Vector velocity = Vector::Zero();  ///< of `pivot`
  Vector spin = Vector::Zero();
  Vector pivot = Vector::Zero();

  Vector velocity_at(const Vector& point) const { return velocity + spin.cross(point - pivot); }
};

WallMoment wall_at(const Wall& wall, double time_s);

}  // namespace repose::dem
