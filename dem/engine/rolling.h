#pragma once

#include "dem/engine/contact_force.h"

namespace repose::dem {

/// What rolling friction needs to know of a touching pair. Body b of a wall has no inertia.
struct Roll {
  Vector normal;  ///< unit, from a to b
  Vector spin;    ///< of a against b, rad/s
  double normal_force = 0;
  double overlap = 0;
  double reduced_radius = 0;
  double reduced_inertia = 0;  ///< of both bodies about their centres, kg m^2
  double contact_inertia = 0;  ///< of both bodies about the contact, kg m^2
};

/// LIGGGHTS's `cdt`: mu_r F_n R* against the relative spin, less its part about the normal
/// (LIGGGHTS-PUBLIC manual, "rolling_friction cdt"). It never takes more spin than there is.
/// Proved by Rolling.* in tests/dem/rolling_test.cpp.
inline Vector relative_constant_torque(const Roll& roll, const ContactLaw& law, double timestep) {
  const double size = roll.spin.norm();
  if (size == 0) return Vector::Zero();
  const double torque = law.rolling_friction * roll.normal_force * roll.reduced_radius;
  const double most = .5 * roll.reduced_inertia * size / timestep;
  const Vector full = roll.spin * (-std::min(torque, most) / size);
  return full - roll.normal * roll.normal.dot(full);
}

/// Elastic-plastic spring-dashpot: k_r = 2.25 k_n mu_r^2 R*^2 up to mu_r R* F_n, and below that
/// limit a damper of .3 of the critical (Ai, Chen, Rotter, Ooi 2011, Powder Technology 206, model
/// C, eqs. 27-33, with the stiffness of Jiang et al. 2005). Proved by Rolling.* in
/// tests/dem/rolling_test.cpp.
inline Vector elastic_plastic_torque(const Roll& roll, const ContactLaw& law, double timestep,
                                     ContactMemory& memory) {
  constexpr double kDampingRatio = .3;
  const double arm = law.rolling_friction * roll.reduced_radius;
  const double limit = arm * roll.normal_force;
  const double a = std::sqrt(roll.reduced_radius * roll.overlap);
  const double stiffness = 2.25 * (4.0 / 3) * law.reduced_young_pa * a * arm * arm;
  const Vector& n = roll.normal;
  const Vector spin = roll.spin - n * n.dot(roll.spin);
  Vector spring = memory.rolling - n * n.dot(memory.rolling) - stiffness * timestep * spin;
  const double size2 = spring.squaredNorm();
  Vector torque = spring;
  if (size2 >= limit * limit) {
    spring *= size2 > 0 ? limit / std::sqrt(size2) : 0;
    torque = spring;
  } else {
    torque -= 2 * kDampingRatio * std::sqrt(stiffness * roll.contact_inertia) * spin;
  }
  memory.rolling = spring;
  return torque;
}

/// The torque on a of the models that work on the relative spin; b gets the opposite.
inline Vector rolling_torque(RollingModel model, const Roll& roll, const ContactLaw& law,
                             double timestep, ContactMemory& memory) {
  return model == RollingModel::elastic_plastic
             ? elastic_plastic_torque(roll, law, timestep, memory)
             : relative_constant_torque(roll, law, timestep);
}

}  // namespace repose::dem
