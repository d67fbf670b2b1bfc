#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dem/contact/contact_table.h"
#include "dem/vector.h"

namespace repose::dem {

/// What a contact remembers from step to step. All zero: it does not touch.
struct ContactMemory {
  Vector tangential = Vector::Zero();  ///< tangential spring's force on a, N
  Vector rolling = Vector::Zero();     ///< rolling spring's torque on a, N m
  double radius = 0;                   ///< of the contact area, m
};

/// Two surfaces that overlap, seen from body a. Velocities are those of b's surface against a's.
struct Touch {
  Vector normal;       ///< unit, from a to b
  double overlap = 0;  ///< m, > 0
  double reduced_radius = 0;
  double reduced_mass = 0;      ///< of the whole bodies
  double damper_limit = 1e300;  ///< see damper_limit(), N s/m
  Vector half_velocity;         ///< half a step back: what the springs were stretched by
  Vector velocity;              ///< now: what the dampers feel
  double twist = 0;             ///< mean spin of both about the normal, rad/s
};

/// The force on a; b gets the opposite.
struct ContactForce {
  double normal = 0;  ///< size of the push, N, never negative
  Vector total;       ///< N
};

/// The damper that would take all of the relative velocity in one step, shared by the `touching`
/// contacts of two bodies: an explicit damper must stay below it, or it overshoots.
inline double damper_limit(double reduced_mass, double timestep, std::size_t touching) {
  return reduced_mass / (timestep * static_cast<double>(touching));
}

/// All dampers of two bodies together are at most this share of the limit, but for normal ones in
/// the first and last step of an impact. One contact stays below it at every accepted time step; a
/// dozen sphere pairs of two clumps that lie side by side would not. Across the contact spin counts
/// too: 1/m_eff = 3.5/m* for spheres.
inline constexpr double kNormalDamperShare = .8;
inline constexpr double kTangentialDamperShare = .25;

/// Hertz's spring and the damper beside it; never below 0.
///
/// In the first and the last step of an impact the surfaces travel farther than they overlap. The
/// overlap's powers are then averaged over the part of the step's way, and of the one before or
/// after, that lies within the contact: what comes out hardly depends on where in a step an impact
/// begins. The damper's limit is not applied in these steps.
[[gnu::always_inline]] inline double normal_force(const Touch& touch, const ContactLaw& law,
                                                  double timestep, double stiffness, double damper,
                                                  double approach) {
  const double travel = std::abs(approach) * timestep;
  // A little more: the way may be just one step long, but for rounding.
  if (touch.overlap > 1.000001 * travel) {
    return std::max(0.0, 2.0 / 3 * stiffness * touch.overlap + damper * approach);
  }
  const double top = touch.overlap + travel / 2;
  const double root = std::sqrt(top);
  const double mean_spring = 2.0 / 5 * top * top * root / travel;       // of overlap^(3/2)
  const double mean_damper = 4.0 / 5 * top * std::sqrt(root) / travel;  // of overlap^(1/4)
  const double young_root = law.reduced_young_pa * std::sqrt(touch.reduced_radius);
  return std::max(0.0, 4.0 / 3 * young_root * mean_spring +
                           law.normal_damping * std::sqrt(2 * young_root * touch.reduced_mass) *
                               mean_damper * approach);
}

/// Hertz-Mindlin without slip, Coulomb's limit, damping.
///
/// Normal: Hertz, F = 4/3 E* a delta, a = sqrt(R* delta) (Johnson 1985, eqs. 4.22-4.24), with the
/// damper of restitution.h. Tangential: Mindlin's stiffness S_t = 8 G* a, stepwise; the spring
/// turns with the contact and shrinks with a when unloading, so that no energy is made (Thornton,
/// Cummins, Cleary 2013, Powder Technology 233, eqs. 15-17). Small strains: delta << R*. Proved by
/// tests/dem/impact_test.cpp.
[[gnu::always_inline]] inline ContactForce contact_force(const Touch& touch, const ContactLaw& law,
                                                         double timestep, ContactMemory& memory) {
  const Vector& n = touch.normal;
  const double a = std::sqrt(touch.reduced_radius * touch.overlap);
  const double normal_stiffness = 2 * law.reduced_young_pa * a;
  const double tangential_stiffness = 8 * law.reduced_shear_pa * a;
  const double root = std::sqrt(normal_stiffness * touch.reduced_mass);
  const double normal_damper =
      std::min(law.normal_damping * root, kNormalDamperShare * touch.damper_limit);
  const double tangential_damper =
      std::min(law.tangential_damping * root, kTangentialDamperShare * touch.damper_limit);

  const double approach = -touch.velocity.dot(n);
  ContactForce force;
  force.normal = normal_force(touch, law, timestep, normal_stiffness, normal_damper, approach);

  Vector spring = memory.tangential;
  const double old_size2 = spring.squaredNorm();
  if (old_size2 > 0) {
    spring -= n * n.dot(spring);
    const double size2 = spring.squaredNorm();
    // Keeps its size while turning; (1 + q) / 2 is sqrt(q) to 1e-16 for the small turn of one step.
    const double lost = size2 > 0 ? old_size2 / size2 : 0;
    double scale = lost < 1.0000001 ? .5 + .5 * lost : std::sqrt(lost);
    if (a < memory.radius) scale *= a / memory.radius;
    spring = scale * (spring + timestep * touch.twist * n.cross(spring));
  }
  const Vector half_slip = touch.half_velocity - n * n.dot(touch.half_velocity);
  spring += tangential_stiffness * timestep * half_slip;

  const double limit = law.sliding_friction * force.normal;
  const double size2 = spring.squaredNorm();
  Vector tangential = spring;
  if (size2 > limit * limit) {
    spring *= limit / std::sqrt(size2);
    tangential = spring;
  } else if (tangential_damper > 0) {
    tangential += tangential_damper * (touch.velocity + n * approach);
    const double total2 = tangential.squaredNorm();
    if (total2 > limit * limit) tangential *= limit / std::sqrt(total2);
  }
  memory.tangential = spring;
  memory.radius = a;
  force.total = tangential - n * force.normal;
  return force;
}

}  // namespace repose::dem
