#pragma once

#include <algorithm>
#include <type_traits>

#include "dem/engine/contact_force.h"
#include "dem/engine/rows.h"
#include "dem/engine/touching.h"
#include "dem/wall/wall_set.h"

/// What the contacts of a pair share: how the two move, and what all of them together do to both.
namespace repose::dem {

/// What touches what: spheres of bodies a, and Others, which are spheres of bodies b or the
/// FacetContacts of walls.
template <typename Other>
struct Sides {
  const PlacedSphere* spheres = nullptr;
  const Other* others = nullptr;
  ContactMemory* memories = nullptr;
  const BodyMotion* motions_a = nullptr;
  const BodyMotion* motions_b = nullptr;
  const Row* positions_a = nullptr;
  const Row* positions_b = nullptr;
};

/// What the contacts of one pair of grains, or of a grain and a wall, do to both.
struct PairLoad {
  Lanes force;     ///< row: on a, N; b gets the opposite. w: how many spheres touch; 0: nothing
                   ///< else stands here
  Lanes torque_a;  ///< row: N m; w: what constant-torque rolling friction may take
  Lanes torque_b;  ///< likewise

  REPOSE_INLINE bool is_empty() const { return force[3] == 0; }
};

/// A TouchingPair in the step at hand.
struct PairMotion {
  Row position_a;
  Row apart;          ///< from a's centre of mass to b's
  Row velocity;       ///< of b against a, both as rigid as they are, at a's centre; w: reduced mass
  Row spin;           ///< of b against a; w: shared_limit(), N s/m
  Row velocity_kick;  ///< see BodyMotion; w: damper limit
  Row spin_kick;
  Row mean_spin;
};

/// Those of the last step, or of this pair when it has more.
REPOSE_INLINE double contacts_of(const TouchingPair& pair, const BodyMotion& body) {
  return std::max(static_cast<double>(pair.touching), body.velocity.w);
}

REPOSE_INLINE double contacts_per_kg(const TouchingPair& pair, const BodyMotion& body) {
  return contacts_of(pair, body) / body.spin.w;
}

/// Contacts' velocities are those at a's centre and, for their arms, the difference of both spins.
template <typename Other>
REPOSE_INLINE void set_motion(const TouchingPair& pair, const Sides<Other>& sides, double timestep,
                              PairMotion& motion) {
  const BodyMotion& a = sides.motions_a[pair.a];
  const BodyMotion& b = sides.motions_b[pair.b];
  const Lanes position_a = load_row(sides.positions_a[pair.a]);
  const Lanes apart = load_row(sides.positions_b[pair.b]) - position_a;
  const Lanes spin_a = load_row(a.spin);
  const Lanes spin_b = load_row(b.spin);
  const Lanes kick_a = load_row(a.spin_kick);
  const Lanes kick_b = load_row(b.spin_kick);
  const Lanes velocity = load_row(b.velocity) - load_row(a.velocity);
  const Lanes velocity_kick = load_row(b.velocity_kick) - load_row(a.velocity_kick);
  constexpr bool is_wall = std::is_same_v<Other, FacetContact>;
  const double limit =
      shared_limit(contacts_per_kg(pair, a), is_wall ? 0. : contacts_per_kg(pair, b), timestep);
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
REPOSE_INLINE void finish_load(const TouchingPair& pair, const PairMotion& motion, PairLoad& load) {
  const Lanes force = load.force;
  load.force = with_w(force, static_cast<double>(pair.touching));
  load.torque_b = with_w(cross_of_rows(load_row(motion.apart), force) - load.torque_a, force[3]);
}

}  // namespace repose::dem
