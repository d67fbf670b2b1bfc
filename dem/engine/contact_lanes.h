#pragma once

#include <array>
#include <vector>

#include "dem/engine/pair_motion.h"

/// Four contacts in lanes, on their way from pass to pass: see four_contacts.h.
namespace repose::dem {

/// Up to four contacts; those beyond the last one repeat it.
template <typename Other>
struct FourTouching {
  std::array<const PlacedSphere*, kLanes> sphere;
  std::array<const Other*, kLanes> other;
  std::array<ContactMemory*, kLanes> memory;
  std::array<const TouchingPair*, kLanes> pair;
  std::array<const PairMotion*, kLanes> motion;  ///< of round grains: none
  std::array<PairLoad*, kLanes> load;
};

/// PairMotion, in lanes.
struct Motions {
  Vec3<Lanes> apart;
  Columns velocity;
  Columns spin;
  Columns velocity_kick;
  Vec3<Lanes> spin_kick;
  Vec3<Lanes> mean_spin;
};

/// Contacts, in lanes.
struct Contacts {
  Touch<Lanes> touch;
  Vec3<Lanes> arm_a;  ///< from a's centre of mass to the contact
  Vec3<Lanes> arm_b;
  Vec3<Lanes> apart;  ///< from a's centre of mass to b's
  Vec3<Lanes> spin;   ///< of b against a
  Lanes smaller_radius;
};

/// Four contacts on their way from pass to pass.
template <typename Other>
struct Four {
  FourTouching<Other> touching = {};
  Contacts contacts;
  Springs<Lanes> springs;
  Lanes last_push;
  ContactForce<Lanes> force;
};

/// Of the contacts of a pair, by direction: the sum of energies times n n^T, n the normals.
struct DirectedEnergy {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};

/// Room for what is worked on, kept so that nothing is allocated.
template <typename Other>
struct ContactWork {
  std::vector<PairMotion> motions;
  std::vector<DirectedEnergy> energies;  ///< of each pair, where damping is shared
  std::array<Four<Other>, kFoursTogether> fours;
};

template <typename Other>
REPOSE_INLINE Law<Lanes> laws_of(const FourTouching<Other>& four) {
  const ContactLaw* first = four.pair[0]->law;
  Law<Lanes> law = law_of<Lanes>(*first);
  for (std::size_t k = 1; k < kLanes; ++k) {
    const ContactLaw& own = *four.pair[k]->law;
    if (&own == first) continue;
    law.reduced_young.set(k, own.reduced_young_pa);
    law.reduced_shear.set(k, own.reduced_shear_pa);
    law.normal_damping.set(k, own.normal_damping);
    law.tangential_damping.set(k, own.tangential_damping);
    law.sliding_friction.set(k, own.sliding_friction);
    law.rolling_friction.set(k, own.rolling_friction);
  }
  return law;
}

}  // namespace repose::dem
