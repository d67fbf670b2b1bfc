#pragma once

#include <vector>

#include "dem/engine/simulation.h"

namespace repose::dem {

/// A sphere of a clump, where it is now.
struct PlacedSphere {
  Vector centre;
  double radius;
};

/// All grains, an array for each field; a grain's number is its index. World axes, SI units.
struct Bodies {
  std::vector<int> kind;
  std::vector<char> present;
  std::vector<double> mass;
  std::vector<Vector> moments;   ///< principal moments of inertia, kg m^2
  std::vector<Vector> mobility;  ///< 1 / moments
  std::vector<double> reach;     ///< farthest that a sphere reaches from the centre of mass
  std::vector<Vector> position;
  std::vector<Quaternion> orientation;
  std::vector<Eigen::Matrix3d> axes;  ///< of the orientation
  std::vector<Vector> velocity;
  std::vector<Vector> angular_momentum;
  std::vector<Vector> force;   ///< N
  std::vector<Vector> torque;  ///< N m
  // For the contacts of the step at hand:
  std::vector<Vector> spin;
  std::vector<Vector> velocity_kick;  ///< what half a step of the last force adds to the velocity
  std::vector<Vector> spin_kick;      ///< and of the last torque to the spin
  std::vector<double>
      rolling_limit;              ///< torque that constant-torque rolling friction can take, N m
  std::vector<int> first_sphere;  ///< one more than grains: where each one's spheres start
  std::vector<PlacedSphere> spheres;
  std::vector<int> sphere_body;  ///< whose each sphere is

  std::size_t size() const { return kind.size(); }
};

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3);

/// Moves one body by the first half of velocity Verlet: half a kick, then a whole drift.
///
/// The orientation follows the angular momentum by the midpoint rule with Cayley's map (second
/// order; Hairer, Lubich, Wanner 2006, Geometric Numerical Integration, sec. VII.5).
/// Proved by FreeRotation.* in tests/dem/rotation_test.cpp. The sums of force, torque and rolling
/// limit then begin anew, with gravity.
void start_step(Bodies& bodies, std::size_t body, const ClumpShape& shape, const Vector& gravity,
                double timestep);

/// The second half kick.
void finish_step(Bodies& bodies, std::size_t body, double timestep);

/// Places the spheres of one body, and works out its axes and its spin.
void place_spheres(Bodies& bodies, std::size_t body, const ClumpShape& shape);

}  // namespace repose::dem
