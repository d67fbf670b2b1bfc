#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "dem/engine/contact_step.h"
#include "dem/engine/pair_motion.h"
#include "dem/engine/rolling.h"
#include "dem/wall/wall_set.h"

/// The forces of contacts, four at a time: of one pair of grains or of several, or of grains and
/// walls. Some fours go together through three passes: where they are and how they move, what
/// pushes, and what that does to the bodies. In short passes a processor works on several fours at
/// once; in one long one each would wait for its own square roots.
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
  Columns apart;
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
  Lanes reduced_inertia;  ///< see Roll
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

/// Room for what is worked on, kept so that nothing is allocated.
template <typename Other>
struct ContactWork {
  std::vector<PairMotion> motions;
  std::array<Four<Other>, kFoursTogether> fours;
};

/// From sphere to sphere; w: the sum of the radii.
REPOSE_INLINE Columns others_of(const FourTouching<PlacedSphere>& four) {
  const Lanes minus_w = Lanes::Vector4{1, 1, 1, -1};
  return gather([&](std::size_t k) {
    return load_row(*four.other[k]) - load_row(*four.sphere[k]) * minus_w;
  });
}

/// The facets' normals; w: how far they are.
REPOSE_INLINE Columns others_of(const FourTouching<FacetContact>& four) {
  return gather([&](std::size_t k) { return load_row(*four.other[k]); });
}

/// What depends on whether two spheres meet or a sphere and a wall: how deep, and reduced sizes.
REPOSE_INLINE void set_geometry(const FourTouching<PlacedSphere>& /*four*/, const Columns& apart,
                                const Lanes& radius, Contacts& c) {
  const Lanes distance = sqrt(apart.xyz.squared_norm());
  const Lanes other_radius = apart.w - radius;
  c.touch.normal = apart.xyz * (1 / distance);
  c.touch.overlap = apart.w - distance;
  c.touch.reduced_radius = radius * other_radius / apart.w;
  c.smaller_radius = least(radius, other_radius);
}

REPOSE_INLINE void set_geometry(const FourTouching<FacetContact>& four, const Columns& facet,
                                const Lanes& radius, Contacts& c) {
  const Lanes curvature = each([&](std::size_t k) { return four.other[k]->curvature; });
  c.touch.normal = -facet.xyz;
  c.touch.overlap = radius - facet.w;
  c.touch.reduced_radius = radius / (1 + radius * curvature);
  c.smaller_radius = radius / greatest(Lanes(1), radius * curvature);
}

template <typename Other>
REPOSE_INLINE Columns gather(const FourTouching<Other>& four, Row PairMotion::*row) {
  return gather([&](std::size_t k) { return load_row(four.motion[k]->*row); });
}

template <typename Other>
REPOSE_INLINE Motions motions_of(const FourTouching<Other>& four) {
  return {.apart = gather(four, &PairMotion::apart),
          .velocity = gather(four, &PairMotion::velocity),
          .spin = gather(four, &PairMotion::spin),
          .velocity_kick = gather(four, &PairMotion::velocity_kick),
          .spin_kick = gather(four, &PairMotion::spin_kick).xyz,
          .mean_spin = gather(four, &PairMotion::mean_spin).xyz};
}

/// BodyMotion, in lanes.
struct BodyMotions {
  Columns velocity;
  Columns spin;
  Vec3<Lanes> velocity_kick;
  Vec3<Lanes> spin_kick;

  template <typename MotionOfLane>
  REPOSE_INLINE explicit BodyMotions(const MotionOfLane& motion)
      : velocity(gather([&](std::size_t k) { return load_row(motion(k).velocity); })),
        spin(gather([&](std::size_t k) { return load_row(motion(k).spin); })),
        velocity_kick(gather([&](std::size_t k) { return load_row(motion(k).velocity_kick); }).xyz),
        spin_kick(gather([&](std::size_t k) { return load_row(motion(k).spin_kick); }).xyz) {}

  /// See contacts_per_kg(): a round grain's pair has one.
  REPOSE_INLINE Lanes contacts_per_kg() const { return greatest(Lanes(1), velocity.w) / spin.w; }
};

/// Of round grains, straight from the bodies: each pair has one contact, so that nothing is saved
/// by working it out once a pair. The same as set_motion().
REPOSE_INLINE Motions motions_of_round(const FourTouching<PlacedSphere>& four,
                                       const Sides<PlacedSphere>& sides, const Vec3<Lanes>& apart,
                                       double timestep) {
  const BodyMotions a(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_a[four.pair[k]->a]; });
  const BodyMotions b(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_b[four.pair[k]->b]; });
  const auto of_pairs = [&](double TouchingPair::*number) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return four.pair[k]->*number; });
  };
  return {.apart = {apart, of_pairs(&TouchingPair::reduced_inertia)},
          .velocity = {b.velocity.xyz - a.velocity.xyz - b.spin.xyz.cross(apart),
                       of_pairs(&TouchingPair::reduced_mass)},
          .spin = {b.spin.xyz - a.spin.xyz,
                   shared_limit(a.contacts_per_kg(), b.contacts_per_kg(), timestep)},
          .velocity_kick = {b.velocity_kick - a.velocity_kick - b.spin_kick.cross(apart),
                            of_pairs(&TouchingPair::damper_limit)},
          .spin_kick = b.spin_kick - a.spin_kick,
          .mean_spin = (a.spin.xyz + b.spin.xyz) * Lanes(.5)};
}

/// From a's centre to that of its sphere; w: the radius.
template <typename Other>
REPOSE_INLINE Columns to_sphere(const FourTouching<Other>& four) {
  return gather([&](std::size_t k) {
    return load_row(*four.sphere[k]) - load_row(four.motion[k]->position_a);
  });
}

template <typename Other>
REPOSE_INLINE void set_contacts(const Motions& motions, const Columns& to_a, Contacts& c) {
  c.spin = motions.spin.xyz;
  c.touch.shared_limit = motions.spin.w;
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = c.arm_a - motions.apart.xyz;
  c.apart = motions.apart.xyz;
  c.reduced_inertia = motions.apart.w;
  c.touch.reduced_mass = motions.velocity.w;
  c.touch.damper_limit = motions.velocity_kick.w;
  c.touch.half_velocity = motions.velocity.xyz + c.spin.cross(c.arm_a);
  c.touch.velocity =
      c.touch.half_velocity + motions.velocity_kick.xyz + motions.spin_kick.cross(c.arm_a);
  c.touch.twist = c.touch.normal.dot(motions.mean_spin);
}

/// The first pass: where four contacts are, and how they move.
template <bool is_round, typename Other>
REPOSE_INLINE void find_contacts(Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const FourTouching<Other>& four = of.touching;
  Contacts c;
  const Columns others = others_of(four);
  if constexpr (is_round) {
    const Lanes radius = each([&](std::size_t k) { return four.sphere[k]->radius; });
    set_geometry(four, others, radius, c);
    set_contacts<Other>(motions_of_round(four, sides, others.xyz, timestep), {{}, radius}, c);
  } else {
    const Columns to_a = to_sphere(four);
    set_geometry(four, others, to_a.w, c);
    set_contacts<Other>(motions_of(four), to_a, c);
  }
  of.contacts = c;
  const Columns memory = gather([&](std::size_t k) { return load_row(*four.memory[k]); });
  of.last_push = each([&](std::size_t k) { return four.memory[k]->push; });
  of.springs = {memory.xyz, memory.w, of.last_push};
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

/// The second pass: what pushes.
template <typename Other>
REPOSE_INLINE void find_forces(Four<Other>& four, double timestep) {
  Springs<Lanes> springs = four.springs;
  four.force = contact_force(four.contacts.touch, laws_of(four.touching), timestep, springs);
  four.springs = springs;
}

/// Of both bodies about the contact; a wall has no inertia.
template <typename Other>
REPOSE_INLINE Lanes contact_inertia(const Four<Other>& of, const Sides<Other>& sides) {
  const auto about_contact =
      [](const auto& motion, const Vec3<Lanes>& arm) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return motion(k).spin_kick.w; }) +
           each([&](std::size_t k) { return motion(k).spin.w; }) * arm.squared_norm();
  };
  const auto& pair = of.touching.pair;
  const Lanes a =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_a[pair[k]->a]; },
                    of.contacts.arm_a);
  if constexpr (std::is_same_v<Other, FacetContact>) return a;
  const Lanes b =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_b[pair[k]->b]; },
                    of.contacts.arm_b);
  return reduced(a, b);
}

/// The torque on a of the models that work on the relative spin.
template <RollingModel model, typename Other>
REPOSE_INLINE Vec3<Lanes> rolling_torque(const Four<Other>& of, const Sides<Other>& sides,
                                         const Law<Lanes>& law, double timestep) {
  const Contacts& c = of.contacts;
  Roll<Lanes> roll = {.normal = c.touch.normal,
                      .spin = -c.spin,
                      .normal_force = of.force.normal,
                      .last_force = of.last_push,
                      .overlap = c.touch.overlap,
                      .reduced_radius = c.touch.reduced_radius,
                      .reduced_inertia = c.reduced_inertia,
                      .contact_inertia = {}};
  if constexpr (model == RollingModel::relative_constant_torque) {
    return relative_constant_torque(roll, law, timestep);
  }
  roll.contact_inertia = contact_inertia(of, sides);
  const auto& memory = of.touching.memory;
  // The row's w is the push: read, and left alone.
  Vec3<Lanes> spring = gather([&](std::size_t k) { return load(memory[k]->rolling.data()); }).xyz;
  const Vec3<Lanes> torque = elastic_plastic_torque(roll, law, timestep, spring);
  for (std::size_t k = 0; k < kLanes; ++k) {
    memory[k]->rolling = {spring.x[k], spring.y[k], spring.z[k]};
  }
  return torque;
}

/// What four contacts do to the bodies: in lanes.
struct Loads {
  Vec3<Lanes> torque_a;
  Lanes rolling_a;  ///< what constant-torque rolling friction may take
  Lanes rolling_b;
};

template <RollingModel model, typename Other>
REPOSE_INLINE Loads loads_of(const Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const Contacts& c = of.contacts;
  Loads loads = {.torque_a = c.arm_a.cross(of.force.total), .rolling_a = {}, .rolling_b = {}};
  if constexpr (model == RollingModel::constant_torque) {
    const Lanes resistance = laws_of(of.touching).rolling_friction * of.force.normal;
    loads.rolling_a = resistance * sqrt(c.arm_a.squared_norm());
    loads.rolling_b = resistance * sqrt(c.arm_b.squared_norm());
  } else if constexpr (model != RollingModel::none) {
    loads.torque_a += rolling_torque<model>(of, sides, laws_of(of.touching), timestep);
  }
  return loads;
}

/// Adds to the loads of their pairs. Those of round grains, which have one contact, are whole then.
template <bool is_round, typename Other>
REPOSE_INLINE void add_loads(const Four<Other>& of, const Loads& loads) {
  const Rows torques_a = rows_of(loads.torque_a, loads.rolling_a);
  if constexpr (is_round) {
    const Vec3<Lanes> torque_b = of.contacts.apart.cross(of.force.total) - loads.torque_a;
    const Rows torques_b = rows_of(torque_b, loads.rolling_b);
    const Rows forces = rows_of(of.force.total, Lanes(1));
    for (std::size_t k = 0; k < kLanes; ++k) {
      *of.touching.load[k] = {forces.row[k], torques_a.row[k], torques_b.row[k]};
    }
    return;
  }
  const Rows forces = rows_of(of.force.total, loads.rolling_b);
  for (std::size_t k = 0; k < kLanes; ++k) {
    PairLoad& load = *of.touching.load[k];
    load.force += forces.row[k];
    load.torque_a += torques_a.row[k];
  }
}

/// The third pass: what four contacts do to the bodies, and what they remember.
/// @return how deep they are, as fractions of the smaller sphere's radius
template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes finish_contacts(const Four<Other>& of, const Sides<Other>& sides,
                                    double timestep) {
  add_loads<is_round>(of, loads_of<model>(of, sides, timestep));
  const Rows memories = rows_of(of.springs.tangential, of.springs.radius);
  for (std::size_t k = 0; k < kLanes; ++k) {
    ContactMemory& own = *of.touching.memory[k];
    store_row(memories.row[k], own);
    own.push = of.springs.push[k];
  }
  return of.contacts.touch.overlap / of.contacts.smaller_radius;
}

template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
                               double timestep) {
  Lanes deepest;
  for (const Four<Other>& four : fours) {
    deepest = greatest(finish_contacts<is_round, model>(four, sides, timestep), deepest);
  }
  return deepest;
}

template <bool is_round, typename Other>
REPOSE_INLINE Lanes finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
                               RollingModel model, double timestep) {
  switch (model) {
    case RollingModel::none:
      return finish_all<is_round, RollingModel::none>(fours, sides, timestep);
    case RollingModel::constant_torque:
      return finish_all<is_round, RollingModel::constant_torque>(fours, sides, timestep);
    case RollingModel::relative_constant_torque:
      return finish_all<is_round, RollingModel::relative_constant_torque>(fours, sides, timestep);
    case RollingModel::elastic_plastic:
      return finish_all<is_round, RollingModel::elastic_plastic>(fours, sides, timestep);
  }
  return {};
}

/// What lanes beyond the last contact write, for nothing.
struct SpareLane {
  ContactMemory memory;
  PairLoad load;
};

/// What the contacts of some pairs are worked out from, and with.
template <typename Other>
struct Meeting {
  std::span<const TouchingPair> pairs;
  const Sides<Other>& sides;
  PairMotion* motions = nullptr;
  PairLoad* loads = nullptr;
};

/// Puts a contact into a lane.
template <typename Other>
REPOSE_INLINE void set_lane(FourTouching<Other>& four, std::size_t lane, const Touching& touching,
                            const Meeting<Other>& meeting) {
  const TouchingPair& pair = meeting.pairs[static_cast<std::size_t>(touching.pair)];
  four.sphere[lane] = &meeting.sides.spheres[touching.sphere];
  four.other[lane] = &meeting.sides.others[touching.other];
  four.memory[lane] = &meeting.sides.memories[touching.memory];
  four.pair[lane] = &pair;
  four.motion[lane] = &meeting.motions[touching.pair];
  four.load[lane] = &meeting.loads[pair.number];
}

/// Puts the last contacts into lanes, fewer than four: the lanes beyond repeat the last one.
template <typename Other>
void set_last(FourTouching<Other>& four, std::span<const Touching> last,
              const Meeting<Other>& meeting, SpareLane& spare) {
  spare.memory = meeting.sides.memories[last.back().memory];
  for (std::size_t k = 0; k < kLanes; ++k) {
    set_lane(four, k, last[std::min(k, last.size() - 1)], meeting);
    if (k < last.size()) continue;
    four.memory[k] = &spare.memory;
    four.load[k] = &spare.load;
  }
}

/// The loads of pairs, each the sum over its contacts in the order given; their memories are
/// brought up to date.
/// @tparam is_round  that each body is one sphere about its centre is known, which saves time
/// @return the deepest overlap, as a fraction of the smaller sphere's radius
template <bool is_round, typename Other>
REPOSE_INLINE double add_contacts(std::span<const Touching> touching,
                                  std::span<const TouchingPair> pairs, const Sides<Other>& sides,
                                  const ContactStep& step, ContactWork<Other>& work,
                                  PairLoad* loads) {
  const Meeting<Other> meeting = {pairs, sides, work.motions.data(), loads};
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    begin_load(loads[pairs[k].number]);
    set_motion(pairs[k], sides, step.timestep_s, work.motions[k]);
  }
  Lanes deepest;
  SpareLane spare;
  for (std::size_t at = 0; at < touching.size(); at += kLanes * kFoursTogether) {
    const std::span<const Touching> now =
        touching.subspan(at, std::min(touching.size() - at, kLanes * kFoursTogether));
    const std::size_t count = (now.size() + kLanes - 1) / kLanes;
    for (std::size_t n = 0; n < count; ++n) {
      Four<Other>& four = work.fours[n];
      const std::span<const Touching> left = now.subspan(n * kLanes);
      if (left.size() < kLanes) {
        set_last(four.touching, left, meeting, spare);
      } else {
        for (std::size_t k = 0; k < kLanes; ++k) set_lane(four.touching, k, left[k], meeting);
      }
      find_contacts<is_round>(four, sides, step.timestep_s);
    }
    for (std::size_t n = 0; n < count; ++n) find_forces(work.fours[n], step.timestep_s);
    const std::span<const Four<Other>> fours(work.fours.data(), count);
    deepest = greatest(finish_all<is_round>(fours, sides, step.contacts.rolling(), step.timestep_s),
                       deepest);
  }
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    finish_load(pairs[k], work.motions[k], loads[pairs[k].number]);
  }
  return std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

}  // namespace repose::dem
