#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "dem/contact/contact_table.h"
#include "dem/engine/contact_lanes.h"
#include "dem/engine/contact_step.h"
#include "dem/engine/rolling.h"
#include "dem/wall/wall_set.h"

/// Contact forces, four at a time: of one pair of grains or several, or of grains and walls.
/// Batches of fours go through three passes: geometry and motion, forces, loads on the bodies. In
/// short passes the processor overlaps several fours; in one long pass each would stall on its own
/// square roots.
///
/// Shared damping: each contact of a pair damps with its share of the reduced mass, in proportion
/// to elastic energy U,
///   D_i = c sqrt(S_i m* U_i / sum U_j),
/// c sqrt(S m* / N) for N equal ones. Their sum is D = b sqrt(m*) F / sqrt(2 U), F and U the sums,
/// b = c sqrt(6/5), which gives the same restitution whatever F(d) is (dem/THEORY.md, "Several
/// contacts at once"; Feng 2026, arXiv:2604.02533; for the cause Kodam et al. 2009, Chemical
/// Engineering Science 64, 3466). A contact in another direction counts with U_j cos^2. Proved by
/// SharedDamping.* and, in `repose verify`, "spheres one after another".

namespace repose::dem {

/// From sphere to sphere; w: the sum of the radii.
REPOSE_INLINE Columns others_of(const FourActiveContacts<PlacedSphere>& four) {
  const Double4 minus_w = Double4::Vector4{1, 1, 1, -1};
  return gather([&](std::size_t k) {
    return load_row(*four.other[k]) - load_row(*four.sphere[k]) * minus_w;
  });
}

/// The facets' normals; w: their distances.
REPOSE_INLINE Columns others_of(const FourActiveContacts<FacetContact>& four) {
  return gather([&](std::size_t k) { return load_row(*four.other[k]); });
}

/// Overlap and reduced sizes, which differ between two spheres and a sphere on a wall.
REPOSE_INLINE void set_geometry(const FourActiveContacts<PlacedSphere>& /*four*/,
                                const Columns& apart, const Double4& radius, Contacts& c) {
  const Double4 distance = sqrt(apart.xyz.squared_norm());
  const Double4 other_radius = apart.w - radius;
  c.touch.normal = apart.xyz * (1 / distance);
  c.touch.overlap = apart.w - distance;
  c.touch.reduced_radius = radius * other_radius / apart.w;
  c.smaller_radius = min(radius, other_radius);
}

REPOSE_INLINE void set_geometry(const FourActiveContacts<FacetContact>& four, const Columns& facet,
                                const Double4& radius, Contacts& c) {
  const Double4 curvature = each([&](std::size_t k) { return four.other[k]->curvature; });
  c.touch.normal = -facet.xyz;
  c.touch.overlap = radius - facet.w;
  c.touch.reduced_radius = radius / (1 + radius * curvature);
  c.smaller_radius = radius / max(Double4(1), radius * curvature);
}

template <typename Other>
REPOSE_INLINE Columns gather(const FourActiveContacts<Other>& four, Row PairMotion::*row) {
  return gather([&](std::size_t k) { return load_row(four.motion[k]->*row); });
}

template <typename Other>
REPOSE_INLINE Motions motions_of(const FourActiveContacts<Other>& four) {
  return {.apart = gather(four, &PairMotion::apart).xyz,
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
  Vec3<Double4> velocity_kick;
  Vec3<Double4> spin_kick;

  template <typename MotionOfLane>
  REPOSE_INLINE explicit BodyMotions(const MotionOfLane& motion)
      : velocity(gather([&](std::size_t k) { return load_row(motion(k).velocity); })),
        spin(gather([&](std::size_t k) { return load_row(motion(k).spin); })),
        velocity_kick(gather([&](std::size_t k) { return load_row(motion(k).velocity_kick); }).xyz),
        spin_kick(gather([&](std::size_t k) { return load_row(motion(k).spin_kick); }).xyz) {}

  /// See contacts_per_kg(): a pair of round grains has one contact.
  REPOSE_INLINE Double4 contacts_per_kg() const { return max(Double4(1), velocity.w) / spin.w; }
};

/// For round grains, straight from the bodies: each pair has one contact, so computing it once per
/// pair would save nothing. Same result as set_motion().
REPOSE_INLINE Motions motions_of_round(const FourActiveContacts<PlacedSphere>& four,
                                       const Sides<PlacedSphere>& sides, const Vec3<Double4>& apart,
                                       double timestep) {
  const BodyMotions a(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_a[four.pair[k]->a]; });
  const BodyMotions b(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_b[four.pair[k]->b]; });
  const auto of_pairs = [&](double ActivePair::*number) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return four.pair[k]->*number; });
  };
  return {.apart = apart,
          .velocity = {b.velocity.xyz - a.velocity.xyz - b.spin.xyz.cross(apart),
                       of_pairs(&ActivePair::reduced_mass)},
          .spin = {b.spin.xyz - a.spin.xyz,
                   max_stable_damping(a.contacts_per_kg(), b.contacts_per_kg(), timestep)},
          .velocity_kick = {b.velocity_kick - a.velocity_kick - b.spin_kick.cross(apart),
                            of_pairs(&ActivePair::damper_limit)},
          .spin_kick = b.spin_kick - a.spin_kick,
          .mean_spin = (a.spin.xyz + b.spin.xyz) * Double4(.5)};
}

/// From a's centre to that of its sphere; w: the radius.
template <typename Other>
REPOSE_INLINE Columns to_sphere(const FourActiveContacts<Other>& four) {
  return gather([&](std::size_t k) {
    return load_row(*four.sphere[k]) - load_row(four.motion[k]->position_a);
  });
}

REPOSE_INLINE void set_contacts(const Motions& motions, const Columns& to_a, Contacts& c) {
  c.spin = motions.spin.xyz;
  c.touch.max_stable_damping = motions.spin.w;
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = c.arm_a - motions.apart;
  c.apart = motions.apart;
  c.touch.reduced_mass = motions.velocity.w;
  c.touch.damper_limit = motions.velocity_kick.w;
  c.touch.half_velocity = motions.velocity.xyz + c.spin.cross(c.arm_a);
  c.touch.velocity =
      c.touch.half_velocity + motions.velocity_kick.xyz + motions.spin_kick.cross(c.arm_a);
  c.touch.twist = c.touch.normal.dot(motions.mean_spin);
}

template <bool is_round, typename Other>
REPOSE_INLINE void find_contacts(Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const FourActiveContacts<Other>& four = of.touching;
  Contacts c;
  const Columns others = others_of(four);
  if constexpr (is_round) {
    const Double4 radius = each([&](std::size_t k) { return four.sphere[k]->radius; });
    set_geometry(four, others, radius, c);
    set_contacts(motions_of_round(four, sides, others.xyz, timestep), {{}, radius}, c);
  } else {
    const Columns to_a = to_sphere(four);
    set_geometry(four, others, to_a.w, c);
    set_contacts(motions_of(four), to_a, c);
  }
  of.contacts = c;
  const Columns memory = gather([&](std::size_t k) { return load_row(*four.memory[k]); });
  of.last_normal_force = each([&](std::size_t k) { return four.memory[k]->push; });
  of.springs = {memory.xyz, memory.w, of.last_normal_force};
}

/// Adds the contact in one lane.
REPOSE_INLINE void add_energy(double energy, const Vec3<Double4>& normals, std::size_t lane,
                              DirectedEnergy& sum) {
  const Vec3<double> n = {normals.x[lane], normals.y[lane], normals.z[lane]};
  sum.xx += energy * (n.x * n.x);
  sum.yy += energy * (n.y * n.y);
  sum.zz += energy * (n.z * n.z);
  sum.xy += energy * (n.x * n.y);
  sum.yz += energy * (n.y * n.z);
  sum.zx += energy * (n.z * n.x);
}

/// Hertz energy, 8/15 E* sqrt(R* d) d^2, without the factor common to all contacts of a pair.
REPOSE_INLINE Double4 elastic_energy(const ContactGeometry<Double4>& touch) {
  return sqrt(touch.reduced_radius * touch.overlap) * (touch.overlap * touch.overlap);
}

/// Only contacts of different spheres are parallel. Those of a single sphere, in the corner of a
/// mesh or among glued grains, do not share.
template <typename Other>
REPOSE_INLINE bool shares_damping(const ActivePair& pair, const Bodies& bodies) {
  if (pair.touching < 2) return false;
  if constexpr (std::is_same_v<Other, PlacedSphere>) return true;
  const auto a = static_cast<std::size_t>(pair.a);
  return bodies.first_sphere[a + 1] - bodies.first_sphere[a] > 1;
}

/// Reduces the mass of each contact to the share that it damps.
/// @param energies  one per pair; zero: not shared
template <typename Other>
REPOSE_INLINE void share_damping(std::span<Four<Other>> fours, const ActivePair* pairs,
                                 const std::vector<DirectedEnergy>& energies) {
  for (Four<Other>& four : fours) {
    const auto all = [&](double DirectedEnergy::*part) __attribute__((always_inline)) {
      return each([&](std::size_t k) {
        return energies[static_cast<std::size_t>(four.touching.pair[k] - pairs)].*part;
      });
    };
    ContactGeometry<Double4>& touch = four.contacts.touch;
    const Vec3<Double4>& n = touch.normal;
    const Double4 along =
        n.x * n.x * all(&DirectedEnergy::xx) + n.y * n.y * all(&DirectedEnergy::yy) +
        n.z * n.z * all(&DirectedEnergy::zz) +
        2 * (n.x * n.y * all(&DirectedEnergy::xy) + n.y * n.z * all(&DirectedEnergy::yz) +
             n.z * n.x * all(&DirectedEnergy::zx));
    const Double4 own = elastic_energy(touch);
    touch.reduced_mass =
        select(along > own, touch.reduced_mass * (own / along), touch.reduced_mass);
  }
}

/// Sets the damping of contacts whose restitution depends on the speed, by the equivalent speed of
/// each (SpeedDamping in restitution.h). If damping is shared, the mass is the contact's share by
/// elastic energy, so the elastic term is the same for all parallel contacts of a pair.
template <typename Other>
REPOSE_INLINE void damp_by_speed(const Four<Other>& four, Law<Double4>& law) {
  const ContactGeometry<Double4>& touch = four.contacts.touch;
  const Double4 approach = touch.velocity.dot(touch.normal);
  // 2 U / m*, U = 8/15 E* sqrt(R* d) d^2.
  const Double4 stored = 16.0 / 15 * law.reduced_young * elastic_energy(touch) / touch.reduced_mass;
  const Double4 speed2 = approach * approach + stored;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const ContactLaw& own = *four.touching.pair[k]->law;
    if (own.by_speed.is_constant()) continue;
    const SpeedDamping::Factors factors = own.by_speed.at(speed2[k]);
    law.normal_damping.set(k, factors.normal);
    law.tangential_damping.set(k, factors.tangential * own.tangential_root);
  }
}

/// Reduced inertia of both bodies about the contact; a wall's is infinite.
template <typename Other>
REPOSE_INLINE Double4 contact_inertia(const Four<Other>& of, const Sides<Other>& sides) {
  const auto about_contact =
      [](const auto& motion, const Vec3<Double4>& arm) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return motion(k).spin_kick.w; }) +
           each([&](std::size_t k) { return motion(k).spin.w; }) * arm.squared_norm();
  };
  const auto& pair = of.touching.pair;
  const Double4 a =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_a[pair[k]->a]; },
                    of.contacts.arm_a);
  if constexpr (std::is_same_v<Other, FacetContact>) return a;
  const Double4 b =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_b[pair[k]->b]; },
                    of.contacts.arm_b);
  return reduced(a, b);
}

/// The moment of inertia that a contact's torques may act on as if alone: each body's smallest one,
/// divided by its number of contacts; a wall's is infinite.
template <typename Other>
REPOSE_INLINE Double4 inertia_share(const Four<Other>& of, const Sides<Other>& sides) {
  const auto& pair = of.touching.pair;
  const auto contacts_per_inertia = [&](const auto& motion) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return contacts_of(*pair[k], motion(k)); }) /
           each([&](std::size_t k) { return motion(k).spin_kick.w; });
  };
  const Double4 a = contacts_per_inertia(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_a[pair[k]->a]; });
  if constexpr (std::is_same_v<Other, FacetContact>) return 1 / a;
  const Double4 b = contacts_per_inertia(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_b[pair[k]->b]; });
  return 1 / (a + b);
}

/// Torque on a in the models based on the relative spin.
template <RollingModel model, typename Other>
REPOSE_INLINE Vec3<Double4> rolling_torque(const Four<Other>& of, const Sides<Other>& sides,
                                           const Law<Double4>& law, double timestep) {
  const Contacts& c = of.contacts;
  Roll<Double4> roll = {.normal = c.touch.normal,
                        .spin = -c.spin,
                        .normal_force = of.force.normal,
                        .last_force = of.last_normal_force,
                        .overlap = c.touch.overlap,
                        .reduced_radius = c.touch.reduced_radius,
                        .inertia_share = {},
                        .contact_inertia = {}};
  const auto& memory = of.touching.memory;
  // The row's w is the normal force: loaded but not changed.
  Vec3<Double4> spring = gather([&](std::size_t k) { return load(memory[k]->rolling.data()); }).xyz;
  Vec3<Double4> torque;
  if constexpr (model == RollingModel::relative_constant_torque) {
    roll.inertia_share = inertia_share(of, sides);
    torque = relative_constant_torque(roll, law, timestep, spring);
  } else {
    roll.contact_inertia = contact_inertia(of, sides);
    torque = elastic_plastic_torque(roll, law, timestep, spring);
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    memory[k]->rolling = {spring.x[k], spring.y[k], spring.z[k]};
  }
  return torque;
}

/// Loads of four contacts on the bodies, in lanes.
struct Loads {
  Vec3<Double4> torque_a;
  Double4 rolling_a;  ///< the most that constant-torque rolling friction can resist
  Double4 rolling_b;
};

template <RollingModel model, typename Other>
REPOSE_INLINE Loads loads_of(const Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const Contacts& c = of.contacts;
  Loads loads = {.torque_a = c.arm_a.cross(of.force.total), .rolling_a = {}, .rolling_b = {}};
  if constexpr (model == RollingModel::constant_torque) {
    const Double4 resistance = laws_of(of.touching).rolling_friction * of.force.normal;
    loads.rolling_a = resistance * sqrt(c.arm_a.squared_norm());
    loads.rolling_b = resistance * sqrt(c.arm_b.squared_norm());
  } else if constexpr (model != RollingModel::none) {
    loads.torque_a += rolling_torque<model>(of, sides, laws_of(of.touching), timestep);
  }
  return loads;
}

/// Adds to the loads of their pairs. Round grains have one contact, so their loads are then
/// complete.
template <bool is_round, typename Other>
REPOSE_INLINE void add_loads(const Four<Other>& of, const Loads& loads) {
  const Rows torques_a = rows_of(loads.torque_a, loads.rolling_a);
  if constexpr (is_round) {
    const Vec3<Double4> torque_b = of.contacts.apart.cross(of.force.total) - loads.torque_a;
    const Rows torques_b = rows_of(torque_b, loads.rolling_b);
    const Rows forces = rows_of(of.force.total, Double4(1));
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

/// @return overlaps as fractions of the smaller sphere's radius
template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Double4 finish_contacts(const Four<Other>& of, const Sides<Other>& sides,
                                      double timestep) {
  add_loads<is_round>(of, loads_of<model>(of, sides, timestep));
  const Rows memories = rows_of(of.springs.tangential, of.springs.radius);
  for (std::size_t k = 0; k < kLanes; ++k) {
    ContactHistory& own = *of.touching.memory[k];
    store_row(memories.row[k], own);
    own.push = of.springs.push[k];
  }
  return of.contacts.touch.overlap / of.contacts.smaller_radius;
}

template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Double4 finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
                                 double timestep) {
  Double4 deepest;
  for (const Four<Other>& four : fours) {
    deepest = max(finish_contacts<is_round, model>(four, sides, timestep), deepest);
  }
  return deepest;
}

template <bool is_round, typename Other>
REPOSE_INLINE Double4 finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
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

/// The second pass: forces.
template <bool is_by_speed, typename Other>
REPOSE_INLINE void find_forces(Four<Other>& four, double timestep) {
  Springs<Double4> springs = four.springs;
  Law<Double4> law = laws_of(four.touching);
  if constexpr (is_by_speed) damp_by_speed(four, law);
  four.force = contact_force(four.contacts.touch, law, timestep, springs);
  four.springs = springs;
}

/// Dummy output of lanes beyond the last contact.
struct SpareLane {
  ContactHistory memory;
  PairLoad load;
};

/// Inputs and buffers for the contacts of some pairs.
template <typename Other>
struct ContactBatch {
  std::span<const ActivePair> pairs;
  const Sides<Other>& sides;
  PairMotion* motions = nullptr;
  PairLoad* loads = nullptr;
};

/// Puts a contact into a lane.
template <typename Other>
REPOSE_INLINE void set_lane(FourActiveContacts<Other>& four, std::size_t lane,
                            const ActiveContact& touching, const ContactBatch<Other>& meeting) {
  const ActivePair& pair = meeting.pairs[static_cast<std::size_t>(touching.pair)];
  four.sphere[lane] = &meeting.sides.spheres[touching.sphere];
  four.other[lane] = &meeting.sides.others[touching.other];
  four.memory[lane] = &meeting.sides.memories[touching.memory];
  four.pair[lane] = &pair;
  four.motion[lane] = &meeting.motions[touching.pair];
  four.load[lane] = &meeting.loads[pair.number];
}

/// Puts the last contacts, fewer than four, into lanes: unused lanes repeat the last one.
template <typename Other>
void set_last(FourActiveContacts<Other>& four, std::span<const ActiveContact> last,
              const ContactBatch<Other>& meeting, SpareLane& spare) {
  spare.memory = meeting.sides.memories[last.back().memory];
  for (std::size_t k = 0; k < kLanes; ++k) {
    set_lane(four, k, last[std::min(k, last.size() - 1)], meeting);
    if (k < last.size()) continue;
    four.memory[k] = &spare.memory;
    four.load[k] = &spare.load;
  }
}

/// Puts the next contacts into lanes, up to four.
template <typename Other>
REPOSE_INLINE void set_lanes(FourActiveContacts<Other>& four, std::span<const ActiveContact> left,
                             const ContactBatch<Other>& meeting, SpareLane& spare) {
  if (left.size() < kLanes) {
    set_last(four, left, meeting, spare);
  } else {
    for (std::size_t k = 0; k < kLanes; ++k) set_lane(four, k, left[k], meeting);
  }
}

/// The first pass, for up to kBatchesPerBlock fours.
/// @return the fours for the other passes
template <bool is_round, typename Other>
REPOSE_INLINE std::span<Four<Other>> find_all(std::span<const ActiveContact> touching,
                                              const ContactBatch<Other>& meeting, double timestep,
                                              std::span<Four<Other>> fours, SpareLane& spare) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < touching.size(); at += kLanes, ++count) {
    set_lanes(fours[count].touching, touching.subspan(at), meeting, spare);
    find_contacts<is_round>(fours[count], meeting.sides, timestep);
  }
  return fours.first(count);
}

/// Before the passes, if damping is shared: the elastic energy of each pair's contacts by
/// direction.
template <typename Other>
REPOSE_INLINE void find_energies(std::span<const ActiveContact> touching,
                                 const ContactBatch<Other>& meeting, const Bodies& bodies,
                                 std::vector<DirectedEnergy>& energies, SpareLane& spare) {
  energies.assign(meeting.pairs.size(), {});
  for (std::size_t at = 0; at < touching.size(); at += kLanes) {
    const std::span<const ActiveContact> left = touching.subspan(at);
    FourActiveContacts<Other> four = {};
    set_lanes(four, left, meeting, spare);
    Contacts c;
    const Double4 radius = each([&](std::size_t k) { return four.sphere[k]->radius; });
    set_geometry(four, others_of(four), radius, c);
    const Double4 energy = elastic_energy(c.touch);
    for (std::size_t k = 0; k < std::min(left.size(), kLanes); ++k) {
      if (!shares_damping<Other>(*four.pair[k], bodies)) continue;
      add_energy(energy[k], c.touch.normal, k, energies[static_cast<std::size_t>(left[k].pair)]);
    }
  }
}

/// Computes the loads of pairs, each the sum over its contacts in the given order, and updates the
/// contact histories.
/// @tparam is_round  every body is known to be one sphere about its centre, which saves time
/// @return the deepest overlap, as a fraction of the smaller sphere's radius
template <bool is_round, typename Other>
REPOSE_INLINE double add_contacts(std::span<const ActiveContact> touching,
                                  std::span<const ActivePair> pairs, const Sides<Other>& sides,
                                  const ContactStep& step, ContactWork<Other>& work,
                                  PairLoad* loads) {
  constexpr std::size_t kTogether = kLanes * kBatchesPerBlock;
  const ContactBatch<Other> meeting = {pairs, sides, work.motions.data(), loads};
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    begin_load(loads[pairs[k].number]);
    set_motion(pairs[k], sides, step.timestep_s, work.motions[k]);
  }
  Double4 deepest;
  SpareLane spare;
  // Round grains have a single contact, so nothing is shared.
  const bool is_shared = !is_round && step.contacts.damping() == DampingModel::shared;
  if (is_shared) find_energies(touching, meeting, step.bodies, work.energies, spare);
  for (std::size_t at = 0; at < touching.size(); at += kTogether) {
    const auto now = touching.subspan(at, std::min(touching.size() - at, kTogether));
    const std::span<Four<Other>> fours =
        find_all<is_round, Other>(now, meeting, step.timestep_s, work.fours, spare);
    if (is_shared) share_damping(fours, meeting.pairs.data(), work.energies);
    if (step.contacts.is_by_speed()) {
      for (Four<Other>& four : fours) find_forces<true>(four, step.timestep_s);
    } else {
      for (Four<Other>& four : fours) find_forces<false>(four, step.timestep_s);
    }
    deepest =
        max(finish_all<is_round, Other>(fours, sides, step.contacts.rolling(), step.timestep_s),
            deepest);
  }
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    finish_load(pairs[k], work.motions[k], loads[pairs[k].number]);
  }
  return std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

}  // namespace repose::dem
