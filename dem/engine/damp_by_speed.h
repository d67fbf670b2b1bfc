#pragma once

#include "dem/engine/contact_lanes.h"
#include "dem/engine/share_damping.h"

namespace repose::dem {

/// Sets the damping of contacts whose restitution depends on the speed, by the equivalent speed of
/// each (speed_damping.h). Where damping is shared the mass is a contact's share, by elastic
/// energy: all contacts of a pair then have the same.
template <typename Other>
REPOSE_INLINE void damp_by_speed(const Four<Other>& four, Law<Lanes>& law) {
  const Touch<Lanes>& touch = four.contacts.touch;
  const Lanes approach = touch.velocity.dot(touch.normal);
  // 2 U / m*, U = 8/15 E* sqrt(R* d) d^2.
  const Lanes stored = 16.0 / 15 * law.reduced_young * elastic_energy(touch) / touch.reduced_mass;
  const Lanes speed2 = approach * approach + stored;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const ContactLaw& own = *four.touching.pair[k]->law;
    if (own.by_speed.is_constant()) continue;
    const SpeedDamping::Factors factors = own.by_speed.at(speed2[k]);
    law.normal_damping.set(k, factors.normal);
    law.tangential_damping.set(k, factors.tangential * own.tangential_root);
  }
}

}  // namespace repose::dem
