#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "dem/engine/contact_step.h"
#include "dem/engine/rolling.h"
#include "dem/engine/touching.h"

/// The force of four contacts at a time: of one pair of grains or of several, or of grains and
/// walls.
namespace repose::dem {

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
  Row apart;          ///< from a's centre of mass to b's; w: reduced inertia
  Row velocity;       ///< of b against a, both as rigid as they are, at a's centre; w: reduced mass
  Row spin;           ///< of b against a; w: shared_limit(), N s/m
  Row velocity_kick;  ///< see BodyMotion; w: damper limit
  Row spin_kick;
  Row mean_spin;
  const ContactLaw* law = nullptr;
  PairLoad* load = nullptr;
  const BodyMotion* a = nullptr;
  const BodyMotion* b = nullptr;
};

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

/// Up to four contacts; those beyond the last one repeat it.
template <typename Other>
struct FourTouching {
  std::array<const PlacedSphere*, kLanes> sphere;
  std::array<const Other*, kLanes> other;
  std::array<ContactMemory*, kLanes> memory;
  std::array<const PairMotion*, kLanes> pair;
};

/// Contacts, in lanes.
struct Contacts {
  Touch<Lanes> touch;
  Vec3<Lanes> arm_a;  ///< from a's centre of mass to the contact
  Vec3<Lanes> arm_b;
  Vec3<Lanes> spin;  ///< of b against a
  Lanes smaller_radius;
  Lanes reduced_inertia;  ///< see Roll
};

/// Gathers a row of each lane.
template <typename RowOfLane>
REPOSE_INLINE Columns gather(const RowOfLane& row) {
  return columns_of({{row(0), row(1), row(2), row(3)}});
}

template <typename Number>
REPOSE_INLINE Number reduced(const Number& x, const Number& y) {
  return x * y / (x + y);
}

/// Gathers a number of each lane.
template <typename NumberOfLane>
REPOSE_INLINE Lanes each(const NumberOfLane& number) {
  return Lanes::Vector4{number(0), number(1), number(2), number(3)};
}

/// Of two rows; w: 0.
REPOSE_INLINE Lanes cross_of_rows(const Lanes& u, const Lanes& v) {
  const auto next = [](const Lanes& row) __attribute__((always_inline)) {
    return Lanes(__builtin_shufflevector(row.numbers, row.numbers, 1, 2, 0, 3));
  };
  return next(u * next(v) - next(u) * v);
}

/// Puts a number into a row's w.
REPOSE_INLINE Lanes with_w(const Lanes& row, double number) {
  return select(Lanes(Lanes::Vector4{0, 0, 0, 1}) > Lanes(0), Lanes(number), row);
}

/// Those of the last step, or of this pair when it has more.
REPOSE_INLINE double contacts_per_kg(const TouchingPair& pair, const BodyMotion& body) {
  return std::max(static_cast<double>(pair.touching), body.velocity.w) / body.spin.w;
}

/// Contacts' velocities are those at a's centre and, for their arms, the difference of both spins.
template <typename Other>
REPOSE_INLINE PairMotion motion_of(const TouchingPair& pair, const Sides<Other>& sides,
                                   double timestep, PairLoad& load) {
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
  PairMotion motion;
  store_row(position_a, motion.position_a);
  store_row(with_w(apart, pair.reduced_inertia), motion.apart);
  store_row(with_w(velocity - cross_of_rows(spin_b, apart), pair.reduced_mass), motion.velocity);
  store_row(spin_b - spin_a, motion.spin);
  constexpr bool is_wall = std::is_same_v<Other, FacetContact>;
  motion.spin.w =
      shared_limit(contacts_per_kg(pair, a), is_wall ? 0 : contacts_per_kg(pair, b), timestep);
  store_row(with_w(velocity_kick - cross_of_rows(kick_b, apart), pair.damper_limit),
            motion.velocity_kick);
  store_row(kick_b - kick_a, motion.spin_kick);
  store_row((spin_a + spin_b) * .5, motion.mean_spin);
  motion.law = pair.law;
  motion.load = &load;
  motion.a = &a;
  motion.b = &b;
  return motion;
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

template <typename Other>
REPOSE_INLINE Columns gather(const FourTouching<Other>& four, Row PairMotion::*row) {
  return gather([&](std::size_t k) { return load_row(four.pair[k]->*row); });
}

/// From a's centre to that of its sphere; w: the radius.
template <bool is_round, typename Other>
REPOSE_INLINE Columns to_sphere(const FourTouching<Other>& four) {
  const Columns to_a = gather([&](std::size_t k) {
    const Lanes sphere = load_row(*four.sphere[k]);
    return is_round ? sphere : sphere - load_row(four.pair[k]->position_a);
  });
  if constexpr (is_round) return {{}, to_a.w};
  return to_a;
}

/// What depends on whether two spheres meet or a sphere and a wall: how deep, and reduced sizes.
REPOSE_INLINE void set_geometry(const FourTouching<PlacedSphere>& four, const Lanes& radius,
                                Contacts& c) {
  const Lanes minus_w = Lanes::Vector4{1, 1, 1, -1};
  const Columns apart = gather([&](std::size_t k) {
    return load_row(*four.other[k]) - load_row(*four.sphere[k]) * minus_w;
  });  // w: the sum of the radii
  const Lanes distance = sqrt(apart.xyz.squared_norm());
  const Lanes other_radius = apart.w - radius;
  c.touch.normal = apart.xyz * (1 / distance);
  c.touch.overlap = apart.w - distance;
  c.touch.reduced_radius = radius * other_radius / apart.w;
  c.smaller_radius = least(radius, other_radius);
}

REPOSE_INLINE void set_geometry(const FourTouching<FacetContact>& four, const Lanes& radius,
                                Contacts& c) {
  const Columns facet = gather([&](std::size_t k) { return load_row(*four.other[k]); });
  const Lanes curvature = each([&](std::size_t k) { return four.other[k]->curvature; });
  c.touch.normal = -facet.xyz;
  c.touch.overlap = radius - facet.w;
  c.touch.reduced_radius = radius / (1 + radius * curvature);
  c.smaller_radius = radius / greatest(Lanes(1), radius * curvature);
}

template <bool is_round, typename Other>
REPOSE_INLINE Contacts contacts_of(const FourTouching<Other>& four) {
  Contacts c;
  const Columns to_a = to_sphere<is_round>(four);
  set_geometry(four, to_a.w, c);
  const Columns apart = gather(four, &PairMotion::apart);
  const Columns velocity = gather(four, &PairMotion::velocity);
  const Columns kick = gather(four, &PairMotion::velocity_kick);
  const Columns spin = gather(four, &PairMotion::spin);
  c.spin = spin.xyz;
  c.touch.shared_limit = spin.w;
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = c.arm_a - apart.xyz;
  c.reduced_inertia = apart.w;
  c.touch.reduced_mass = velocity.w;
  c.touch.damper_limit = kick.w;
  c.touch.half_velocity = velocity.xyz + c.spin.cross(c.arm_a);
  c.touch.velocity =
      c.touch.half_velocity + kick.xyz + gather(four, &PairMotion::spin_kick).xyz.cross(c.arm_a);
  c.touch.twist = c.touch.normal.dot(gather(four, &PairMotion::mean_spin).xyz);
  return c;
}

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

/// Of both bodies about the contact; a wall has no inertia.
template <typename Other>
REPOSE_INLINE Lanes contact_inertia(const Contacts& c, const FourTouching<Other>& four) {
  const auto about_contact = [&](BodyMotion const* PairMotion::*body, const Vec3<Lanes>& arm)
      __attribute__((always_inline)) {
    const auto motion = [&](std::size_t k) -> const BodyMotion& { return *(four.pair[k]->*body); };
    return each([&](std::size_t k) { return motion(k).spin_kick.w; }) +
           each([&](std::size_t k) { return motion(k).spin.w; }) * arm.squared_norm();
  };
  const Lanes a = about_contact(&PairMotion::a, c.arm_a);
  if constexpr (std::is_same_v<Other, FacetContact>) return a;
  const Lanes b = about_contact(&PairMotion::b, c.arm_b);
  return reduced(a, b);
}

/// The torque on a of the models that work on the relative spin.
template <RollingModel model, typename Other>
REPOSE_INLINE Vec3<Lanes> rolling_torque(const Contacts& c, const Lanes& normal_force,
                                         const Lanes& last_force, const Law<Lanes>& law,
                                         double timestep, const FourTouching<Other>& four) {
  Roll<Lanes> roll = {.normal = c.touch.normal,
                      .spin = -c.spin,
                      .normal_force = normal_force,
                      .last_force = last_force,
                      .overlap = c.touch.overlap,
                      .reduced_radius = c.touch.reduced_radius,
                      .reduced_inertia = c.reduced_inertia,
                      .contact_inertia = {}};
  if constexpr (model == RollingModel::relative_constant_torque) {
    return relative_constant_torque(roll, law, timestep);
  }
  roll.contact_inertia = contact_inertia(c, four);
  // The row's w is the push: read, and left alone.
  Vec3<Lanes> spring =
      gather([&](std::size_t k) { return load(four.memory[k]->rolling.data()); }).xyz;
  const Vec3<Lanes> torque = elastic_plastic_torque(roll, law, timestep, spring);
  for (std::size_t k = 0; k < kLanes; ++k) {
    four.memory[k]->rolling = {spring.x[k], spring.y[k], spring.z[k]};
  }
  return torque;
}

/// Adds four contacts to the loads of their pairs, and brings their memories up to date.
/// @return how deep they are, as fractions of the smaller sphere's radius
template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes add_four(const FourTouching<Other>& four, double timestep) {
  const Contacts c = contacts_of<is_round>(four);
  const Law<Lanes> law = laws_of(four);
  const Columns memory = gather([&](std::size_t k) { return load_row(*four.memory[k]); });
  const Lanes last_push = each([&](std::size_t k) { return four.memory[k]->push; });
  Springs<Lanes> springs = {memory.xyz, memory.w, last_push};
  const ContactForce<Lanes> force = contact_force(c.touch, law, timestep, springs);

  Vec3<Lanes> torque_a = c.arm_a.cross(force.total);
  Lanes rolling_a;
  Lanes rolling_b;
  if constexpr (model == RollingModel::constant_torque) {
    const Lanes resistance = law.rolling_friction * force.normal;
    rolling_a = resistance * sqrt(c.arm_a.squared_norm());
    rolling_b = resistance * sqrt(c.arm_b.squared_norm());
  } else if constexpr (model != RollingModel::none) {
    torque_a += rolling_torque<model>(c, force.normal, last_push, law, timestep, four);
  }
  const Rows memories = rows_of(springs.tangential, springs.radius);
  const Rows forces = rows_of(force.total, rolling_b);
  const Rows torques_a = rows_of(torque_a, rolling_a);
  for (std::size_t k = 0; k < kLanes; ++k) {
    ContactMemory& own = *four.memory[k];
    store_row(memories.row[k], own);
    own.push = springs.push[k];
    PairLoad& load = *four.pair[k]->load;
    load.force += forces.row[k];
    load.torque_a += torques_a.row[k];
  }
  return c.touch.overlap / c.smaller_radius;
}

/// What the lanes beyond the last contact work on, for nothing: a copy of what that has.
struct SpareLane {
  ContactMemory memory;
  PairLoad load;
  PairMotion pair;
};

/// Puts a contact into a lane.
template <typename Other>
REPOSE_INLINE void set_lane(FourTouching<Other>& four, std::size_t lane, const Touching& touching,
                            const Sides<Other>& sides, const PairMotion* motions) {
  four.sphere[lane] = &sides.spheres[touching.sphere];
  four.other[lane] = &sides.others[touching.other];
  four.memory[lane] = &sides.memories[touching.memory];
  four.pair[lane] = &motions[touching.pair];
}

/// Puts the last contacts into lanes, fewer than four: the lanes beyond repeat the last one.
template <typename Other>
void set_last(FourTouching<Other>& four, std::span<const Touching> last, const Sides<Other>& sides,
              const PairMotion* motions, SpareLane& spare) {
  spare.memory = sides.memories[last.back().memory];
  spare.pair = motions[last.back().pair];
  spare.pair.load = &spare.load;
  for (std::size_t k = 0; k < kLanes; ++k) {
    set_lane(four, k, last[std::min(k, last.size() - 1)], sides, motions);
    if (k < last.size()) continue;
    four.memory[k] = &spare.memory;
    four.pair[k] = &spare.pair;
  }
}

template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes add_with(std::span<const Touching> touching, const Sides<Other>& sides,
                             const PairMotion* motions, double timestep) {
  Lanes deepest;
  SpareLane spare;
  for (std::size_t at = 0; at < touching.size(); at += kLanes) {
    const std::span<const Touching> left = touching.subspan(at);
    FourTouching<Other> four = {};
    if (left.size() < kLanes) {
      set_last(four, left, sides, motions, spare);
    } else {
      for (std::size_t k = 0; k < kLanes; ++k) set_lane(four, k, left[k], sides, motions);
    }
    deepest = greatest(add_four<is_round, model>(four, timestep), deepest);
  }
  return deepest;
}

template <bool is_round, typename Other>
REPOSE_INLINE Lanes add_contacts_of(std::span<const Touching> touching, const Sides<Other>& sides,
                                    const PairMotion* motions, RollingModel model,
                                    double timestep) {
  switch (model) {
    case RollingModel::none:
      return add_with<is_round, RollingModel::none>(touching, sides, motions, timestep);
    case RollingModel::constant_torque:
      return add_with<is_round, RollingModel::constant_torque>(touching, sides, motions, timestep);
    case RollingModel::relative_constant_torque:
      return add_with<is_round, RollingModel::relative_constant_torque>(touching, sides, motions,
                                                                        timestep);
    case RollingModel::elastic_plastic:
      return add_with<is_round, RollingModel::elastic_plastic>(touching, sides, motions, timestep);
  }
  return {};
}

/// The loads of pairs, each the sum over its contacts in the order given; their memories are
/// brought up to date.
/// @param motions  room for as many as there are pairs
/// @tparam is_round  that each body is one sphere about its centre is known, which saves time
/// @return the deepest overlap, as a fraction of the smaller sphere's radius
template <bool is_round, typename Other>
REPOSE_INLINE double add_contacts(std::span<const Touching> touching,
                                  std::span<const TouchingPair> pairs, const Sides<Other>& sides,
                                  const ContactStep& step, PairMotion* motions, PairLoad* loads) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PairLoad& load = loads[pairs[k].number];
    begin_load(load);
    motions[k] = motion_of(pairs[k], sides, step.timestep_s, load);
  }
  const Lanes deepest =
      add_contacts_of<is_round>(touching, sides, motions, step.contacts.rolling(), step.timestep_s);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    finish_load(pairs[k], motions[k], *motions[k].load);
  }
  return std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

}  // namespace repose::dem
