#pragma once

#include "dem/engine/contact_force.h"

namespace repose::dem {

/// What rolling friction needs to know of a touching pair. Body b of a wall has no inertia.
template <typename Number>
struct Roll {
  Vec3<Number> normal;  ///< unit, from a to b
  Vec3<Number> spin;    ///< of a against b, rad/s
  Number normal_force = {};
  Number overlap = {};
  Number reduced_radius = {};
  Number reduced_inertia = {};  ///< of both bodies about their centres, kg m^2
  Number contact_inertia = {};  ///< of both bodies about the contact, kg m^2
};

/// LIGGGHTS's `cdt`: mu_r F_n R* against the relative spin, less its part about the normal
/// (LIGGGHTS-PUBLIC manual, "rolling_friction cdt"). It never takes more spin than there is.
/// Proved by Rolling.* in tests/dem/rolling_test.cpp.
template <typename Number>
REPOSE_INLINE Vec3<Number> relative_constant_torque(const Roll<Number>& roll,
                                                    const Law<Number>& law, double timestep) {
  const Number size = sqrt(roll.spin.squared_norm());
  const Number torque = law.rolling_friction * roll.normal_force * roll.reduced_radius;
  const Number most = .5 * roll.reduced_inertia * size / timestep;
  const Number fraction = select(size > Number(0), Number(-least(torque, most) / size), Number{});
  const Vec3<Number> full = roll.spin * fraction;
  return full - roll.normal * roll.normal.dot(full);
}

/// Elastic-plastic spring-dashpot: k_r = 2.25 k_n mu_r^2 R*^2 up to mu_r R* F_n, and below that
/// limit a damper of .3 of the critical (Ai, Chen, Rotter, Ooi 2011, Powder Technology 206, model
/// C, eqs. 27-33, with the stiffness of Jiang et al. 2005). Proved by Rolling.* in
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
  spring = spring - n * n.dot(spring) - spin * (stiffness * timestep);
  const Number size2 = spring.squared_norm();
  const auto yields = size2 >= limit * limit;
  const Number fraction = select(size2 > Number(0), Number(limit / sqrt(size2)), Number{});
  spring = spring * select(yields, fraction, Number(1));
  const Number damper = 2 * kDampingRatio * sqrt(stiffness * roll.contact_inertia);
  return spring - spin * select(yields, Number{}, damper);
}

}  // namespace repose::dem
