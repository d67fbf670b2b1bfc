#pragma once

#include <array>
#include <vector>

#include "dem/engine/lanes.h"
#include "dem/engine/simulation.h"

namespace repose::dem {

/// A sphere of a clump at its current position.
struct alignas(32) PlacedSphere {
  Vector centre;
  double radius;
};

/// Vectors of many bodies, one array per coordinate.
class VectorArray {
 public:
  Vector operator[](std::size_t k) const { return {xyz_[0][k], xyz_[1][k], xyz_[2][k]}; }
  void set(std::size_t k, const Vector& value);
  void resize(std::size_t size);
  const double* coordinate(std::size_t axis) const { return xyz_[axis].data(); }
  double* coordinate(std::size_t axis) { return xyz_[axis].data(); }

 private:
  std::array<std::vector<double>, 3> xyz_;
};

/// What contacts need to know about a body, packed into two cache lines. World axes.
struct alignas(64) BodyMotion {
  Row velocity;       ///< w: number of spheres in contact at the last step
  Row spin;           ///< w: mass, kg
  Row velocity_kick;  ///< velocity change by half a step of the last force
  Row spin_kick;      ///< spin change by the last torque; w: smallest moment of inertia, kg m^2
};

/// Load on a body from contacts and gravity.
struct alignas(64) BodyLoad {
  Row force;   ///< N; w: number of spheres in contact
  Row torque;  ///< N m; w: the most that constant-torque rolling friction can resist
};

/// All grains, one array per field; a grain's number is its index. World axes, SI units.
///
/// The arrays of numbers and rows are padded beyond the last body so that all can be processed four
/// at a time; the padding values are harmless.
struct Bodies {
  std::vector<int> kind;
  std::vector<int> material;
  std::vector<double> presence;         ///< 1; 0 once the grain has left
  std::vector<double> bounding_radius;  ///< largest extent from the centre of mass
  std::vector<double> mass;
  VectorArray inverse_inertia;                     ///< 1 / principal moments of inertia, 1/(kg m^2)
  std::vector<Row> position;                       ///< w: 0
  std::array<std::vector<double>, 4> orientation;  ///< x, y, z, w
  VectorArray velocity;
  VectorArray angular_momentum;
  std::vector<BodyLoad> load;      ///< of the last step, or being summed in this one
  std::vector<BodyMotion> motion;  ///< in the current step
  std::vector<int> first_sphere;   ///< one more entry than grains: where each one's spheres start
  std::vector<PlacedSphere> spheres;
  std::vector<int> sphere_body;  ///< the body of each sphere
  bool is_round = true;          ///< every body is one sphere about its centre of mass

  std::size_t size() const { return kind.size(); }
  bool is_present(std::size_t body) const { return presence[body] != 0; }
  Quaternion orientation_of(std::size_t body) const;
  Vector spin_of(std::size_t body) const;
};

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3);

/// First half of velocity Verlet for all bodies: half a kick, then a full drift. Places their
/// spheres and resets their loads to gravity.
///
/// The orientation is integrated from the angular momentum by the midpoint rule with the Cayley map
/// (second order; Hairer, Lubich, Wanner 2006, Geometric Numerical Integration, sec. VII.5). Proved
/// by FreeRotation.* in tests/dem/rotation_test.cpp.
void start_step(Bodies& bodies, const std::vector<GrainKind>& kinds, const Vector& gravity,
                double timestep, int threads);

/// The second half kick.
void finish_step(Bodies& bodies, double timestep, int threads);

}  // namespace repose::dem
