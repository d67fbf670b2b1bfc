#pragma once

#include <array>
#include <vector>

#include "dem/engine/lanes.h"
#include "dem/engine/simulation.h"

namespace repose::dem {

/// A sphere of a clump, where it is now.
struct alignas(32) PlacedSphere {
  Vector centre;
  double radius;
};

/// Vectors of many bodies, an array for each coordinate.
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

/// What contacts need to know of a body, together in two lines of the cache. World axes.
struct alignas(64) BodyMotion {
  Row velocity;       ///< w: spheres that touched something at the last step
  Row spin;           ///< w: mass, kg
  Row velocity_kick;  ///< what half a step of the last force adds to the velocity
  Row spin_kick;      ///< and of the last torque to the spin; w: least moment of inertia, kg m^2
};

/// What contacts and gravity do to a body.
struct alignas(64) BodyLoad {
  Row force;   ///< N; w: spheres that touch something
  Row torque;  ///< N m; w: the torque that constant-torque rolling friction can take
};

/// All grains, an array for each field; a grain's number is its index. World axes, SI units.
///
/// The arrays of numbers and rows are longer than there are bodies, so that the last ones too can
/// be worked on four at a time; what stands there is harmless.
struct Bodies {
  std::vector<int> kind;
  std::vector<int> material;
  std::vector<double> presence;         ///< 1, or 0 once a grain has left
  std::vector<double> bounding_radius;  ///< farthest that a sphere reaches from the centre of mass
  std::vector<double> mass;
  VectorArray inverse_inertia;                     ///< 1 / principal moments of inertia, 1/(kg m^2)
  std::vector<Row> position;                       ///< w: 0
  std::array<std::vector<double>, 4> orientation;  ///< x, y, z, w
  VectorArray velocity;
  VectorArray angular_momentum;
  std::vector<BodyLoad> load;      ///< of the last step, or gathered in this one
  std::vector<BodyMotion> motion;  ///< in the step at hand
  std::vector<int> first_sphere;   ///< one more than grains: where each one's spheres start
  std::vector<PlacedSphere> spheres;
  std::vector<int> sphere_body;  ///< whose each sphere is
  bool is_round = true;          ///< each is one sphere about its centre of mass

  std::size_t size() const { return kind.size(); }
  bool is_present(std::size_t body) const { return presence[body] != 0; }
  Quaternion orientation_of(std::size_t body) const;
  Vector spin_of(std::size_t body) const;
};

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3);

/// Moves all bodies by the first half of velocity Verlet: half a kick, then a whole drift. Places
/// their spheres; their loads begin anew, with gravity.
///
/// The orientation follows the angular momentum by the midpoint rule with Cayley's map (second
/// order; Hairer, Lubich, Wanner 2006, Geometric Numerical Integration, sec. VII.5).
/// Proved by FreeRotation.* in tests/dem/rotation_test.cpp.
void start_step(Bodies& bodies, const std::vector<GrainKind>& kinds, const Vector& gravity,
                double timestep, int threads);

/// The second half kick.
void finish_step(Bodies& bodies, double timestep, int threads);

}  // namespace repose::dem
