#pragma once

#include <string>

namespace repose::dem {

/// What a grain or a wall is made of.
struct Material {
  std::string name;
  double density_kg_m3 = 0;  ///< > 0; of no effect on walls
  double young_modulus_pa = 0;
  double poisson_ratio = 0;  ///< 0 <= nu < .5
};

/// How the torque that resists rolling is defined. The coefficient means something else in each.
enum class RollingModel {
  none,
  /// EDEM's standard rolling friction: on each body, mu_r F_n times its own distance from the
  /// centre of mass to the contact, against its own spin.
  constant_torque,
  /// LIGGGHTS's `cdt`: mu_r F_n times the reduced radius, against the relative spin.
  relative_constant_torque,
  /// Rolling spring with a plastic limit (EPSD): comes to rest.
  elastic_plastic,
};

/// How the contacts damp that two bodies have with each other at the same time.
enum class DampingModel {
  /// Each as if it were alone, with the whole reduced mass: the more spheres of a clump touch, the
  /// less it rebounds.
  per_contact,
  /// Each with its share of the reduced mass, so that all together rebound as one would.
  shared,
};

/// What two materials do to each other.
struct PairCoefficients {
  double restitution = 1;       ///< .01 ... 1: what comes out of a central impact of two spheres
  double sliding_friction = 0;  ///< >= 0
  double rolling_friction = 0;  ///< >= 0
};

}  // namespace repose::dem
