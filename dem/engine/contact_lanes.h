#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "dem/engine/contact_force.h"
#include "dem/engine/lanes.h"
#include "dem/wall/wall_set.h"

/// What the contacts of a pair share: how the two move, and what all of them together do to both.
/// Four contacts in lanes, on their way from pass to pass: see four_contacts.h.

namespace repose::dem {

/// What touches what: spheres of bodies a, and Others, which are spheres of bodies b or the
/// FacetContacts of walls.
template <typename Other>
struct Sides {
  const PlacedSphere* spheres = nullptr;
  const Other* others = nullptr;
  ContactHistory* memories = nullptr;
  const BodyMotion* motions_a = nullptr;
  const BodyMotion* motions_b = nullptr;
  const Row* positions_a = nullptr;
  const Row* positions_b = nullptr;
};

/// What the contacts of one pair of grains, or of a grain and a wall, do to both.
struct PairLoad {
  Double4 force;     ///< row: on a, N; b gets the opposite. w: how many spheres touch; 0: nothing
                     ///< else stands here
  Double4 torque_a;  ///< row: N m; w: what constant-torque rolling friction may take
  Double4 torque_b;  ///< likewise

  REPOSE_INLINE bool is_empty() const { return force[3] == 0; }
};

/// A ActivePair in the step at hand.
struct PairMotion {
  Row position_a;
  Row apart;          ///< from a's centre of mass to b's
  Row velocity;       ///< of b against a, both as rigid as they are, at a's centre; w: reduced mass
  Row spin;           ///< of b against a; w: max_stable_damping(), N s/m
  Row velocity_kick;  ///< see BodyMotion; w: damper limit
  Row spin_kick;
  Row mean_spin;
};

/// Those of the last step, or of this pair when it has more.
REPOSE_INLINE double contacts_of(const ActivePair& pair, const BodyMotion& body) {
  return std::max(static_cast<double>(pair.touching), body.velocity.w);
}

REPOSE_INLINE double contacts_per_kg(const ActivePair& pair, const BodyMotion& body) {
  return contacts_of(pair, body) / body.spin.w;
}

/// Contacts' velocities are those at a's centre and, for their arms, the difference of both spins.
template <typename Other>
REPOSE_INLINE void set_motion(const ActivePair& pair, const Sides<Other>& sides, double timestep,
                              PairMotion& motion) {
  const BodyMotion& a = sides.motions_a[pair.a];
  const BodyMotion& b = sides.motions_b[pair.b];
  const Double4 position_a = load_row(sides.positions_a[pair.a]);
  const Double4 apart = load_row(sides.positions_b[pair.b]) - position_a;
  const Double4 spin_a = load_row(a.spin);
  const Double4 spin_b = load_row(b.spin);
  const Double4 kick_a = load_row(a.spin_kick);
  const Double4 kick_b = load_row(b.spin_kick);
  const Double4 velocity = load_row(b.velocity) - load_row(a.velocity);
  const Double4 velocity_kick = load_row(b.velocity_kick) - load_row(a.velocity_kick);
  constexpr bool is_wall = std::is_same_v<Other, FacetContact>;
  const double limit = max_stable_damping(contacts_per_kg(pair, a),
                                          is_wall ? 0. : contacts_per_kg(pair, b), timestep);
  store_row(position_a, motion.position_a);
  store_row(apart, motion.apart);
  store_row(with_w(velocity - cross_of_rows(spin_b, apart), pair.reduced_mass), motion.velocity);
  store_row(with_w(spin_b - spin_a, limit), motion.spin);
  store_row(with_w(velocity_kick - cross_of_rows(kick_b, apart), pair.damper_limit),
            motion.velocity_kick);
  store_row(kick_b - kick_a, motion.spin_kick);
  store_row((spin_a + spin_b) * .5, motion.mean_spin);
}

/// Begins the load of a pair whose contacts are to be added.
REPOSE_INLINE void begin_load(PairLoad& load) {
  load.force = {};
  load.torque_a = {};
}

/// Once all contacts are added: b's torque is that of the opposite force, seen from b's centre.
/// Until then the force's w is what constant-torque rolling friction may take from b.
REPOSE_INLINE void finish_load(const ActivePair& pair, const PairMotion& motion, PairLoad& load) {
  const Double4 force = load.force;
  load.force = with_w(force, static_cast<double>(pair.touching));
  load.torque_b = with_w(cross_of_rows(load_row(motion.apart), force) - load.torque_a, force[3]);
}

/// Up to four contacts; those beyond the last one repeat it.
template <typename Other>
struct FourActiveContacts {
  std::array<const PlacedSphere*, kLanes> sphere;
  std::array<const Other*, kLanes> other;
  std::array<ContactHistory*, kLanes> memory;
  std::array<const ActivePair*, kLanes> pair;
  std::array<const PairMotion*, kLanes> motion;  ///< of round grains: none
  std::array<PairLoad*, kLanes> load;
};

/// PairMotion, in lanes.
struct Motions {
  Vec3<Double4> apart;
  Columns velocity;
  Columns spin;
  Columns velocity_kick;
  Vec3<Double4> spin_kick;
  Vec3<Double4> mean_spin;
};

/// Contacts, in lanes.
struct Contacts {
  ContactGeometry<Double4> touch;
  Vec3<Double4> arm_a;  ///< from a's centre of mass to the contact
  Vec3<Double4> arm_b;
  Vec3<Double4> apart;  ///< from a's centre of mass to b's
  Vec3<Double4> spin;   ///< of b against a
  Double4 smaller_radius;
};

/// Four contacts on their way from pass to pass.
template <typename Other>
struct Four {
  FourActiveContacts<Other> touching = {};
  Contacts contacts;
  Springs<Double4> springs;
  Double4 last_normal_force;
  ContactForce<Double4> force;
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
  std::array<Four<Other>, kBatchesPerBlock> fours;
};

template <typename Other>
REPOSE_INLINE Law<Double4> laws_of(const FourActiveContacts<Other>& four) {
  const ContactLaw* first = four.pair[0]->law;
  Law<Double4> law = law_of<Double4>(*first);
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
