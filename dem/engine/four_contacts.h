#pragma once

#include <algorithm>
#include <span>

#include "dem/engine/contact_step.h"
#include "dem/engine/rolling.h"

/// The force of four contacts at a time: of one pair of grains or of several, or of grains and
/// walls.
namespace repose::dem {

/// What the contacts of one pair of grains, or of a grain and a wall, do to both.
struct PairLoad {
  Lanes force;          ///< row: on a, N; b gets the opposite
  Lanes torque_a;       ///< row: N m; w: what constant-torque rolling friction may take
  Lanes torque_b;       ///< likewise
  double overlap = 0;   ///< deepest, as a fraction of the smaller sphere's radius; 0: no contact
  double touching = 0;  ///< how many spheres
};

/// What all contacts of a pair of grains, or of a grain and a wall, share.
struct TouchingPair {
  const BodyMotion* a = nullptr;
  const BodyMotion* b = nullptr;
  const Row* position_a = nullptr;
  const Row* position_b = nullptr;
  const ContactLaw* law = nullptr;
  PairLoad* load = nullptr;
};

/// A sphere of body a that touches the Other: a PlacedSphere of body b, or the FacetContact of a
/// wall.
template <typename Other>
struct Touching {
  const TouchingPair* pair = nullptr;
  const PlacedSphere* sphere = nullptr;
  const Other* other = nullptr;
  ContactMemory* memory = nullptr;
};

/// Up to four of them; those beyond the last one repeat it.
template <typename Other>
using FourTouching = std::array<const Touching<Other>*, kLanes>;

/// Contacts, in lanes.
struct Contacts {
  Touch<Lanes> touch;
  Vec3<Lanes> arm_a;  ///< from a's centre of mass to the contact
  Vec3<Lanes> arm_b;
  Vec3<Lanes> spin;  ///< of a against b
  Lanes smaller_radius;
  Lanes reduced_inertia;  ///< see Roll
  Lanes contact_inertia;
};

/// Gathers a row of each lane.
template <typename RowOfLane>
REPOSE_INLINE Columns gather(const RowOfLane& row) {
  return columns_of({{row(0), row(1), row(2), row(3)}});
}

REPOSE_INLINE Lanes reduced(const Lanes& x, const Lanes& y) { return x * y / (x + y); }

/// Gathers a number of each lane.
template <typename NumberOfLane>
REPOSE_INLINE Lanes each(const NumberOfLane& number) {
  return Lanes::Vector4{number(0), number(1), number(2), number(3)};
}

/// From the bodies' centres to those of the spheres; w: their radii.
template <bool is_round, typename SphereOfLane, typename CentreOfLane>
REPOSE_INLINE Columns arms(const SphereOfLane& sphere, const CentreOfLane& centre) {
  if constexpr (is_round) return {{}, gather(sphere).w};
  return gather([&](std::size_t k) { return sphere(k) - centre(k); });
}

/// What depends on whether two spheres meet or a sphere and a wall: where, and reduced sizes.
/// @param spin_a, spin_kick_a  with mass and least inertia
template <bool is_round>
REPOSE_INLINE void set_geometry(const FourTouching<PlacedSphere>& four, const Columns& spin_a,
                                const Columns& spin_b, const Columns& inertia_a,
                                const Columns& inertia_b, Contacts& c) {
  const Columns to_a =
      arms<is_round>([&](std::size_t k) { return load_row(*four[k]->sphere); },
                     [&](std::size_t k) { return load_row(*four[k]->pair->position_a); });
  const Columns to_b =
      arms<is_round>([&](std::size_t k) { return load_row(*four[k]->other); },
                     [&](std::size_t k) { return load_row(*four[k]->pair->position_b); });
  const Columns apart =
      gather([&](std::size_t k) { return load_row(*four[k]->other) - load_row(*four[k]->sphere); });
  const Lanes distance = sqrt(apart.xyz.squared_norm());
  c.touch.normal = apart.xyz * (1 / distance);
  c.touch.overlap = to_a.w + to_b.w - distance;
  c.touch.reduced_radius = reduced(to_a.w, to_b.w);
  c.touch.reduced_mass = reduced(spin_a.w, spin_b.w);
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = to_b.xyz - c.touch.normal * (to_b.w - c.touch.overlap * .5);
  c.smaller_radius = least(to_a.w, to_b.w);
  c.reduced_inertia = reduced(inertia_a.w, inertia_b.w);
  c.contact_inertia = reduced(inertia_a.w + spin_a.w * c.arm_a.squared_norm(),
                              inertia_b.w + spin_b.w * c.arm_b.squared_norm());
}

template <bool is_round>
REPOSE_INLINE void set_geometry(const FourTouching<FacetContact>& four, const Columns& spin_a,
                                const Columns& /*spin_b*/, const Columns& inertia_a,
                                const Columns& /*inertia_b*/, Contacts& c) {
  const Columns to_a =
      arms<is_round>([&](std::size_t k) { return load_row(*four[k]->sphere); },
                     [&](std::size_t k) { return load_row(*four[k]->pair->position_a); });
  const Columns across = gather([&](std::size_t k) {
    return load_row(*four[k]->pair->position_a) - load_row(*four[k]->pair->position_b);
  });
  const Columns facet = gather([&](std::size_t k) { return load_row(*four[k]->other); });
  c.touch.normal = -facet.xyz;
  c.touch.overlap = to_a.w - facet.w;
  c.touch.reduced_radius = to_a.w;
  c.touch.reduced_mass = spin_a.w;
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = c.arm_a + across.xyz;
  c.smaller_radius = to_a.w;
  c.reduced_inertia = inertia_a.w;
  c.contact_inertia = inertia_a.w + spin_a.w * c.arm_a.squared_norm();
}

template <bool is_round, typename Other>
REPOSE_INLINE Contacts contacts_of(const FourTouching<Other>& four, double timestep) {
  const auto difference = [&](Row BodyMotion::*row) __attribute__((always_inline)) {
    return gather([&](std::size_t k) {
      return load_row(four[k]->pair->b->*row) - load_row(four[k]->pair->a->*row);
    });
  };
  const Columns spin_a = gather([&](std::size_t k) { return load_row(four[k]->pair->a->spin); });
  const Columns spin_b = gather([&](std::size_t k) { return load_row(four[k]->pair->b->spin); });
  const Columns kick_a =
      gather([&](std::size_t k) { return load_row(four[k]->pair->a->spin_kick); });
  const Columns kick_b =
      gather([&](std::size_t k) { return load_row(four[k]->pair->b->spin_kick); });
  const Lanes touching = each([&](std::size_t k) { return four[k]->pair->load->touching; });

  Contacts c;
  set_geometry<is_round>(four, spin_a, spin_b, kick_a, kick_b, c);
  c.touch.damper_limit = damper_limit(c.touch.reduced_mass, timestep, touching);
  c.touch.half_velocity =
      difference(&BodyMotion::velocity).xyz + spin_b.xyz.cross(c.arm_b) - spin_a.xyz.cross(c.arm_a);
  c.touch.velocity = c.touch.half_velocity + difference(&BodyMotion::velocity_kick).xyz +
                     kick_b.xyz.cross(c.arm_b) - kick_a.xyz.cross(c.arm_a);
  c.touch.twist = .5 * c.touch.normal.dot(spin_a.xyz + spin_b.xyz);
  c.spin = spin_a.xyz - spin_b.xyz;
  return c;
}

template <typename Other>
REPOSE_INLINE Law<Lanes> laws_of(const FourTouching<Other>& four) {
  const ContactLaw* first = four[0]->pair->law;
  Law<Lanes> law = law_of<Lanes>(*first);
  for (std::size_t k = 1; k < kLanes; ++k) {
    const ContactLaw& own = *four[k]->pair->law;
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

/// The torque on a of the models that work on the relative spin.
template <RollingModel model, typename Other>
REPOSE_INLINE Vec3<Lanes> rolling_torque(const Contacts& c, const Lanes& normal_force,
                                         const Law<Lanes>& law, double timestep,
                                         const FourTouching<Other>& four, std::size_t count) {
  const Roll<Lanes> roll = {.normal = c.touch.normal,
                            .spin = c.spin,
                            .normal_force = normal_force,
                            .overlap = c.touch.overlap,
                            .reduced_radius = c.touch.reduced_radius,
                            .reduced_inertia = c.reduced_inertia,
                            .contact_inertia = c.contact_inertia};
  if constexpr (model == RollingModel::relative_constant_torque) {
    return relative_constant_torque(roll, law, timestep);
  }
  Vec3<Lanes> spring;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vector& own = four[k]->memory->rolling;
    spring.x.set(k, own.x());
    spring.y.set(k, own.y());
    spring.z.set(k, own.z());
  }
  const Vec3<Lanes> torque = elastic_plastic_torque(roll, law, timestep, spring);
  for (std::size_t k = 0; k < count; ++k) {
    four[k]->memory->rolling = {spring.x[k], spring.y[k], spring.z[k]};
  }
  return torque;
}

/// Adds the first `count` of four contacts to the loads of their pairs, and brings their memories
/// up to date.
template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE void add_four(const FourTouching<Other>& four, std::size_t count, double timestep) {
  const Contacts c = contacts_of<is_round>(four, timestep);
  const Law<Lanes> law = laws_of(four);
  const Columns memory = gather([&](std::size_t k) { return load_row(*four[k]->memory); });
  const Lanes last_push = each([&](std::size_t k) { return four[k]->memory->push; });
  Springs<Lanes> springs = {memory.xyz, memory.w, last_push};
  const ContactForce<Lanes> force = contact_force(c.touch, law, timestep, springs);

  Vec3<Lanes> torque_a = c.arm_a.cross(force.total);
  Vec3<Lanes> torque_b = -c.arm_b.cross(force.total);
  Lanes rolling_a;
  Lanes rolling_b;
  if constexpr (model == RollingModel::constant_torque) {
    const Lanes resistance = law.rolling_friction * force.normal;
    rolling_a = resistance * sqrt(c.arm_a.squared_norm());
    rolling_b = resistance * sqrt(c.arm_b.squared_norm());
  } else if constexpr (model != RollingModel::none) {
    const Vec3<Lanes> rolling = rolling_torque<model>(c, force.normal, law, timestep, four, count);
    torque_a += rolling;
    torque_b -= rolling;
  }
  const Rows memories = rows_of(springs.tangential, springs.radius);
  const Rows forces = rows_of(force.total, Lanes(0));
  const Rows torques_a = rows_of(torque_a, rolling_a);
  const Rows torques_b = rows_of(torque_b, rolling_b);
  const Lanes depth = c.touch.overlap / c.smaller_radius;
  for (std::size_t k = 0; k < count; ++k) {
    store_row(memories.row[k], *four[k]->memory);
    four[k]->memory->push = springs.push[k];
    PairLoad& load = *four[k]->pair->load;
    load.force += forces.row[k];
    load.torque_a += torques_a.row[k];
    load.torque_b += torques_b.row[k];
    load.overlap = std::max(load.overlap, depth[k]);
  }
}

template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE void add_with(std::span<const Touching<Other>> touching, double timestep) {
  for (std::size_t at = 0; at < touching.size(); at += kLanes) {
    const std::size_t count = std::min(kLanes, touching.size() - at);
    FourTouching<Other> four;
    for (std::size_t k = 0; k < kLanes; ++k) four[k] = &touching[at + std::min(k, count - 1)];
    add_four<is_round, model>(four, count, timestep);
  }
}

/// Adds contacts to the loads of their pairs in the order given.
template <bool is_round, typename Other>
REPOSE_INLINE void add_contacts_of(std::span<const Touching<Other>> touching, RollingModel model,
                                   double timestep) {
  switch (model) {
    case RollingModel::none:
      return add_with<is_round, RollingModel::none>(touching, timestep);
    case RollingModel::constant_torque:
      return add_with<is_round, RollingModel::constant_torque>(touching, timestep);
    case RollingModel::relative_constant_torque:
      return add_with<is_round, RollingModel::relative_constant_torque>(touching, timestep);
    case RollingModel::elastic_plastic:
      return add_with<is_round, RollingModel::elastic_plastic>(touching, timestep);
  }
}

template <typename Other>
REPOSE_INLINE void add_contacts(std::span<const Touching<Other>> touching,
                                const ContactStep& step) {
  if (step.bodies.is_round) {
    add_contacts_of<true>(touching, step.contacts.rolling(), step.timestep_s);
  } else {
    add_contacts_of<false>(touching, step.contacts.rolling(), step.timestep_s);
  }
}

}  // namespace repose::dem
