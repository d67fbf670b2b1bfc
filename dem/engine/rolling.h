#pragma once

#include <cmath>

#include "dem/engine/contact_force.h"

namespace repose::dem {

/// What rolling friction needs to know about a contact. If b is a wall, only a's inertia counts.
template <typename Number>
struct Roll {
  Vec3<Number> normal;  ///< unit, from a to b
  Vec3<Number> spin;    ///< of a relative to b, rad/s
  Number normal_force = {};
  Number last_force = {};  ///< normal, of the previous step
  Number overlap = {};
  Number reduced_radius = {};
  Number inertia_share = {};    ///< see inertia_share(), kg m^2
  Number contact_inertia = {};  ///< of both bodies about the contact, kg m^2
};

template <typename Number>
REPOSE_INLINE Vec3<Number> limited(const Vec3<Number>& torque, const Number& limit) {
  const Number size = sqrt(torque.squared_norm());
  return torque * select(size > limit, Number(limit / size), Number(1));
}

/// LIGGGHTS's `cdt`: mu_r F_n R* against the relative spin, minus the part about the normal
/// (LIGGGHTS-PUBLIC manual, "rolling_friction cdt").
///
/// Without spin, a spring holds up to that limit, as in Coulomb friction (Cundall and Strack 1979,
/// Geotechnique 29). It merely approximates a rigid law, so it is as stiff as the time step allows,
/// kStiffness J / step^2 with J the contact's share of the inertia; a damper of kDamping times the
/// critical one stops its oscillation. Both stay stable however many contacts a body has
/// (dem/THEORY.md). Proved by Rolling.* in tests/dem/rolling_test.cpp.
/// @param spring  torque on a, N m, kept from step to step, including the part about the normal
template <typename Number>
REPOSE_INLINE Vec3<Number> relative_constant_torque(const Roll<Number>& roll,
                                                    const Law<Number>& law, double timestep,
                                                    Vec3<Number>& spring) {
  constexpr double kStiffness = .1;
  constexpr double kDamping = .5;
  const Number limit = law.rolling_friction * roll.normal_force * roll.reduced_radius;
  const Number per_spin = roll.inertia_share * (kStiffness / timestep);
  const Number damper = roll.inertia_share * (2 * kDamping * std::sqrt(kStiffness) / timestep);
  spring = limited(spring - roll.spin * per_spin, limit);
  const Vec3<Number> full = limited(spring - roll.spin * damper, limit);
  return full - roll.normal * roll.normal.dot(full);
}

/// Fraction of a step in which a spring is below its limit; for the step in which it begins to
/// yield, the part up to there. With all or nothing, the energy taken by its damper would depend on
/// the time step (clumps on a plate rolled 1.6 % farther at .14 of the stable one; now within .1
/// %).
template <typename Number>
REPOSE_INLINE Number part_below(const Number& old_limit, const Number& limit,
                                const Number& old_size, const Number& size) {
  const auto yields = size >= limit;
  const auto yielded = old_size >= .999999999 * old_limit;  // allows for rounding
  const Number begins = max(Number{}, min(Number(1), Number(limit - old_size) / (size - old_size)));
  const auto grows = size > old_size;
  const Number up_to_there = select(grows, begins, Number{});
  return select(yields, select(yielded, Number{}, up_to_there), Number(1));
}

/// Elastic-plastic spring-dashpot: k_r = 2.25 k_n mu_r^2 R*^2 up to mu_r R* F_n, and below that
/// limit a damper of .3 times the critical one (Ai, Chen, Rotter, Ooi 2011, Powder Technology 206,
/// model C, eqs. 27-33, with the stiffness of Jiang et al. 2005). Proved by Rolling.* in
/// tests/dem/rolling_test.cpp.
/// @param spring  torque on a, N m, from step to step
template <typename Number>
REPOSE_INLINE Vec3<Number> elastic_plastic_torque(const Roll<Number>& roll, const Law<Number>& law,
                                                  double timestep, Vec3<Number>& spring) {
  constexpr double kDampingRatio = .3;
  const Number arm = law.rolling_friction * roll.reduced_radius;
  const Number limit = arm * roll.normal_force;
  const Number a = sqrt(roll.reduced_radius * roll.overlap);
  const Number stiffness = 2.25 * (4.0 / 3) * law.reduced_young * a * arm * arm;
  const Vec3<Number>& n = roll.normal;
  const Vec3<Number> spin = roll.spin - n * n.dot(roll.spin);
  const Vec3<Number> old = spring - n * n.dot(spring);
  spring = old - spin * (stiffness * timestep);
  const Number size = sqrt(spring.squared_norm());
  const Number part =
      part_below(Number(arm * roll.last_force), limit, Number(sqrt(old.squared_norm())), size);
  spring = spring * select(size > limit, Number(limit / size), Number(1));
  const Number damper = 2 * kDampingRatio * sqrt(stiffness * roll.contact_inertia);
  return spring - spin * (part * damper);
}

}  // namespace repose::dem
