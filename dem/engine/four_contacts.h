#pragma once

#include <algorithm>
#include <span>

#include "dem/engine/contact_step.h"
#include "dem/engine/damp_by_speed.h"
#include "dem/engine/find_contacts.h"
#include "dem/engine/finish_contacts.h"
#include "dem/engine/share_damping.h"

/// The forces of contacts, four at a time: of one pair of grains or of several, or of grains and
/// walls. Some fours go together through three passes: where they are and how they move, what
/// pushes, and what that does to the bodies. In short passes a processor works on several fours at
/// once; in one long one each would wait for its own square roots.
namespace repose::dem {

/// The second pass: what pushes.
template <bool is_by_speed, typename Other>
REPOSE_INLINE void find_forces(Four<Other>& four, double timestep) {
  Springs<Lanes> springs = four.springs;
  Law<Lanes> law = laws_of(four.touching);
  if constexpr (is_by_speed) damp_by_speed(four, law);
  four.force = contact_force(four.contacts.touch, law, timestep, springs);
  four.springs = springs;
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

/// Puts the next contacts into lanes, up to four.
template <typename Other>
REPOSE_INLINE void set_lanes(FourTouching<Other>& four, std::span<const Touching> left,
                             const Meeting<Other>& meeting, SpareLane& spare) {
  if (left.size() < kLanes) {
    set_last(four, left, meeting, spare);
  } else {
    for (std::size_t k = 0; k < kLanes; ++k) set_lane(four, k, left[k], meeting);
  }
}

/// The first pass, of up to kFoursTogether fours.
/// @return what goes on to the others
template <bool is_round, typename Other>
REPOSE_INLINE std::span<Four<Other>> find_all(std::span<const Touching> touching,
                                              const Meeting<Other>& meeting, double timestep,
                                              std::span<Four<Other>> fours, SpareLane& spare) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < touching.size(); at += kLanes, ++count) {
    set_lanes(fours[count].touching, touching.subspan(at), meeting, spare);
    find_contacts<is_round>(fours[count], meeting.sides, timestep);
  }
  return fours.first(count);
}

/// Before the passes, with shared damping: where the elastic energy of each pair's contacts acts.
template <typename Other>
REPOSE_INLINE void find_energies(std::span<const Touching> touching, const Meeting<Other>& meeting,
                                 const Bodies& bodies, std::vector<DirectedEnergy>& energies,
                                 SpareLane& spare) {
  energies.assign(meeting.pairs.size(), {});
  for (std::size_t at = 0; at < touching.size(); at += kLanes) {
    const std::span<const Touching> left = touching.subspan(at);
    FourTouching<Other> four = {};
    set_lanes(four, left, meeting, spare);
    Contacts c;
    const Lanes radius = each([&](std::size_t k) { return four.sphere[k]->radius; });
    set_geometry(four, others_of(four), radius, c);
    const Lanes energy = elastic_energy(c.touch);
    for (std::size_t k = 0; k < std::min(left.size(), kLanes); ++k) {
      if (!shares_damping<Other>(*four.pair[k], bodies)) continue;
      add_energy(energy[k], c.touch.normal, k, energies[static_cast<std::size_t>(left[k].pair)]);
    }
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
  constexpr std::size_t kTogether = kLanes * kFoursTogether;
  const Meeting<Other> meeting = {pairs, sides, work.motions.data(), loads};
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    begin_load(loads[pairs[k].number]);
    set_motion(pairs[k], sides, step.timestep_s, work.motions[k]);
  }
  Lanes deepest;
  SpareLane spare;
  // Round grains have one contact, which shares with nobody.
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
    deepest = greatest(
        finish_all<is_round, Other>(fours, sides, step.contacts.rolling(), step.timestep_s),
        deepest);
  }
  for (std::size_t k = 0; k < pairs.size() && !is_round; ++k) {
    finish_load(pairs[k], work.motions[k], loads[pairs[k].number]);
  }
  return std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

}  // namespace repose::dem
