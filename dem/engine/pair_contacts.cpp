#include "dem/engine/pair_contacts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace repose::dem {
namespace {

/// A byte of 1 or 0 for each lane.
constexpr std::array<std::uint32_t, 16> kBytesOf = {
    0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001, 0x00010100, 0x00010101,
    0x01000000, 0x01000001, 0x01000100, 0x01000101, 0x01010000, 0x01010001, 0x01010100, 0x01010101};

/// Notes which of `count` spheres from `first` on touch now. What has parted forgets.
/// @return whether they are others than before
REPOSE_INLINE bool note_touching(NeighbourList& list, std::size_t first, std::size_t count,
                                 unsigned now) {
  if (count == kLanes) {
    std::uint32_t before = 0;
    std::memcpy(&before, &list.has_touched[first], sizeof before);
    if (before == kBytesOf[now]) return false;  // as most do
  }
  bool has_changed = false;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto touches = static_cast<std::uint8_t>(now >> lane & 1U);
    std::uint8_t& before = list.has_touched[first + lane];
    if (before > touches) list.memories[first + lane] = {};
    has_changed = has_changed || before != touches;
    before = touches;
  }
  return has_changed;
}

/// Looks which of `count` near spheres from `first` on touch.
/// @return whether they are others than before
REPOSE_INLINE bool look_at(const ContactStep& step, NeighbourList& list, std::size_t first,
                           std::size_t count) {
  const Lanes minus_w = Lanes::Vector4{1, 1, 1, -1};
  const Columns apart = gather([&](std::size_t lane) {
    const NearSpheres& near = list.spheres[first + std::min(lane, count - 1)];
    const Lanes a = load_row(step.bodies.spheres[static_cast<std::size_t>(near.a)]);
    const Lanes b = load_row(step.bodies.spheres[static_cast<std::size_t>(near.b)]);
    return b - a * minus_w;  // w: the sum of the radii
  });
  const Lanes distance2 = apart.xyz.squared_norm();
  // Spheres of one centre have no normal to push along: the audit stops such a run.
  const LaneMask touches = (distance2 < apart.w * apart.w) & (distance2 > Lanes(0));
  return note_touching(list, first, count, bits_of(touches) & ((1U << count) - 1));
}

/// Looks which of the near spheres from ... to - 1 touch.
/// @return whether they are others than before
REPOSE_INLINE bool look_at_all(const ContactStep& step, NeighbourList& list, std::size_t from,
                               std::size_t to) {
  bool has_changed = false;
  std::size_t first = from;
  for (; first + kLanes <= to; first += kLanes) has_changed |= look_at(step, list, first, kLanes);
  if (first < to) has_changed |= look_at(step, list, first, to - first);
  return has_changed;
}

TouchingPair touching_pair(const ContactStep& step, const NearGrains& near, std::size_t number,
                           std::size_t touching) {
  const BodyMotion& a = step.bodies.motion[static_cast<std::size_t>(near.a)];
  const BodyMotion& b = step.bodies.motion[static_cast<std::size_t>(near.b)];
  const double reduced_mass = reduced(a.spin.w, b.spin.w);
  return {
      .a = near.a,
      .b = near.b,
      .law = &step.contacts.law(step.material(near.a), step.material(near.b)),
      .number = static_cast<int>(number),
      .touching = static_cast<int>(touching),
      .reduced_mass = reduced_mass,
      .damper_limit = damper_limit(reduced_mass, step.timestep_s, static_cast<double>(touching))};
}

Sides<PlacedSphere> sides_of(const Bodies& bodies, std::vector<ContactMemory>& memories) {
  return {.spheres = bodies.spheres.data(),
          .others = bodies.spheres.data(),
          .memories = memories.data(),
          .motions_a = bodies.motion.data(),
          .motions_b = bodies.motion.data(),
          .positions_a = bodies.position.data(),
          .positions_b = bodies.position.data()};
}

/// Looks up which of pairs `first` ... touch, and what their contacts share.
void look_up(const ContactStep& step, const NeighbourList& list, std::size_t first,
             std::size_t count, TouchingChunk& chunk) {
  chunk.pairs.clear();
  chunk.contacts.clear();
  for (std::size_t number = 0; number < count; ++number) {
    const NearGrains& near = list.grains[first + number];
    const std::size_t start = chunk.contacts.size();
    for (int k = near.first; k < near.first + near.count; ++k) {
      if (list.has_touched[static_cast<std::size_t>(k)] == 0) continue;
      const NearSpheres& spheres = list.spheres[static_cast<std::size_t>(k)];
      chunk.contacts.push_back({.sphere = spheres.a,
                                .other = spheres.b,
                                .memory = k,
                                .pair = static_cast<int>(chunk.pairs.size())});
    }
    const std::size_t touching = chunk.contacts.size() - start;
    if (touching > 0) chunk.pairs.push_back(touching_pair(step, near, number, touching));
  }
  chunk.is_known = true;
}

REPOSE_FOR_EACH_MACHINE
bool have_changed(const ContactStep& step, NeighbourList& list, std::size_t from, std::size_t to) {
  return look_at_all(step, list, from, to);
}

REPOSE_FOR_EACH_MACHINE
double add_pair_contacts(const TouchingChunk& chunk, const Sides<PlacedSphere>& sides,
                         const ContactStep& step, ContactWork<PlacedSphere>& work,
                         PairLoad* loads) {
  return step.bodies.is_round
             ? add_contacts<true>(chunk.contacts, chunk.pairs, sides, step, work, loads)
             : add_contacts<false>(chunk.contacts, chunk.pairs, sides, step, work, loads);
}

}  // namespace

double find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t number,
                       std::span<PairLoad> loads) {
  thread_local ContactWork<PlacedSphere> work = {
      .motions = std::vector<PairMotion>(kPairsTogether), .energies = {}, .fours = {}};
  const std::size_t first = number * kPairsTogether;
  const NearGrains& last = list.grains[first + loads.size() - 1];
  TouchingChunk& chunk = list.touching[number];
  if (have_changed(step, list, static_cast<std::size_t>(list.grains[first].first),
                   static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count)) ||
      !chunk.is_known) {
    look_up(step, list, first, loads.size(), chunk);
  }
  return add_pair_contacts(chunk, sides_of(step.bodies, list.memories), step, work, loads.data());
}

}  // namespace repose::dem
