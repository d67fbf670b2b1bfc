#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "dem/engine/contact_force.h"
#include "dem/engine/lanes.h"
#include "dem/wall/wall_set.h"

/// What the contacts of a pair share: the relative motion of the bodies and the total load on both.
/// Four contacts in lanes, as passed from pass to pass: see four_contacts.h.

namespace repose::dem {

/// The two sides of contacts: spheres of bodies a, and Others, which are spheres of bodies b or
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

/// Load from the contacts of one pair of grains, or of a grain and a wall, on both.
struct PairLoad {
  Double4 force;     ///< row: on a, N; b gets the opposite. w: number of contacts; 0: the rest
                     ///< is not set
  Double4 torque_a;  ///< row: N m; w: the most that constant-torque rolling friction can resist
  Double4 torque_b;  ///< likewise

  REPOSE_INLINE bool is_empty() const { return force[3] == 0; }
};

/// An ActivePair in the current step.
struct PairMotion {
  Row position_a;
  Row apart;          ///< from a's centre of mass to b's
  Row velocity;       ///< of b relative to a, both as rigid bodies, at a's centre; w: reduced mass
  Row spin;           ///< of b relative to a; w: max_stable_damping(), N s/m
  Row velocity_kick;  ///< see BodyMotion; w: damper limit
  Row spin_kick;
  Row mean_spin;
};

/// The body's contacts at the last step, or those of this pair if more.
REPOSE_INLINE double contacts_of(const ActivePair& pair, const BodyMotion& body) {
  return std::max(static_cast<double>(pair.touching), body.velocity.w);
}

REPOSE_INLINE double contacts_per_kg(const ActivePair& pair, const BodyMotion& body) {
  return contacts_of(pair, body) / body.spin.w;
}

/// A contact's velocity is that at a's centre plus, by its arm, the difference of the spins.
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

/// Resets the load of a pair before its contacts are added.
REPOSE_INLINE void begin_load(PairLoad& load) {
  load.force = {};
  load.torque_a = {};
}

/// To be called once all contacts are added: b's torque is that of the opposite force about b's
/// centre. Until then the force's w holds the most that constant-torque rolling friction can resist
/// on b.
REPOSE_INLINE void finish_load(const ActivePair& pair, const PairMotion& motion, PairLoad& load) {
  const Double4 force = load.force;
  load.force = with_w(force, static_cast<double>(pair.touching));
  load.torque_b = with_w(cross_of_rows(load_row(motion.apart), force) - load.torque_a, force[3]);
}

/// Up to four contacts; unused lanes repeat the last one.
template <typename Other>
struct FourActiveContacts {
  std::array<const PlacedSphere*, kLanes> sphere;
  std::array<const Other*, kLanes> other;
  std::array<ContactHistory*, kLanes> memory;
  std::array<const ActivePair*, kLanes> pair;
  std::array<const PairMotion*, kLanes> motion;  ///< unused for round grains
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
  Vec3<Double4> spin;   ///< of b relative to a
  Double4 smaller_radius;
};

/// Four contacts, as passed from pass to pass.
template <typename Other>
struct Four {
  FourActiveContacts<Other> touching = {};
  Contacts contacts;
  Springs<Double4> springs;
  Double4 last_normal_force;
  ContactForce<Double4> force;
};

/// Elastic energy of a pair's contacts by direction: the sum of energy times n n^T, n the normals.
struct DirectedEnergy {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};

/// Reusable buffers, so that nothing is allocated per step.
template <typename Other>
struct ContactWork {
  std::vector<PairMotion> motions;
  std::vector<DirectedEnergy> energies;  ///< of each pair, if damping is shared
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
