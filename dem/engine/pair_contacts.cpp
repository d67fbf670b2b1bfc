#include "dem/engine/pair_contacts.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace repose::dem {
namespace {

using TouchingSpheres = Touching<PlacedSphere>;

/// Which of four lanes are meant, in order, by a bit for each; and how many.
constexpr std::array<std::array<std::uint32_t, kLanes>, 16> kLanesOf = {{{0, 0, 0, 0},
                                                                         {0, 0, 0, 0},
                                                                         {1, 0, 0, 0},
                                                                         {0, 1, 0, 0},
                                                                         {2, 0, 0, 0},
                                                                         {0, 2, 0, 0},
                                                                         {1, 2, 0, 0},
                                                                         {0, 1, 2, 0},
                                                                         {3, 0, 0, 0},
                                                                         {0, 3, 0, 0},
                                                                         {1, 3, 0, 0},
                                                                         {0, 1, 3, 0},
                                                                         {2, 3, 0, 0},
                                                                         {0, 2, 3, 0},
                                                                         {1, 2, 3, 0},
                                                                         {0, 1, 2, 3}}};
constexpr std::array<std::uint8_t, 16> kCountOf = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/// A byte of 1 or 0 for each lane.
constexpr std::array<std::uint32_t, 16> kBytesOf = {
    0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001, 0x00010100, 0x00010101,
    0x01000000, 0x01000001, 0x01000100, 0x01000101, 0x01010000, 0x01010001, 0x01010100, 0x01010101};

/// Notes which of `count` spheres from `first` on touch now. What has parted forgets.
REPOSE_INLINE void note_touching(NeighbourList& list, std::size_t first, std::size_t count,
                                 unsigned now) {
  if (count == kLanes) {
    std::uint32_t before = 0;
    std::memcpy(&before, &list.has_touched[first], sizeof before);
    if (before == kBytesOf[now]) return;  // as most do
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto touches = static_cast<std::uint8_t>(now >> lane & 1U);
    std::uint8_t& before = list.has_touched[first + lane];
    if (before > touches) list.memories[first + lane] = {};
    before = touches;
  }
}

/// Lists which of the near spheres from ... to - 1 touch. What has parted forgets.
/// @param touching  with room for three more than there can be
/// @return how many do
REPOSE_INLINE std::size_t find_touching(const ContactStep& step, NeighbourList& list,
                                        std::size_t from, std::size_t to, std::uint32_t* touching) {
  const Lanes minus_w = Lanes::Vector4{1, 1, 1, -1};
  std::size_t found = 0;
  for (std::size_t first = from; first < to; first += kLanes) {
    const Columns apart = gather([&](std::size_t lane) {
      const NearSpheres& near = list.spheres[std::min(first + lane, to - 1)];
      const Lanes a = load_row(step.bodies.spheres[static_cast<std::size_t>(near.a)]);
      const Lanes b = load_row(step.bodies.spheres[static_cast<std::size_t>(near.b)]);
      return b - a * minus_w;  // w: the sum of the radii
    });
    const Lanes distance2 = apart.xyz.squared_norm();
    // Spheres of one centre have no normal to push along: the audit stops such a run.
    const LaneMask touches = (distance2 < apart.w * apart.w) & (distance2 > Lanes(0));
    const std::size_t count = std::min(kLanes, to - first);
    const unsigned now = bits_of(touches) & ((1U << count) - 1);
    note_touching(list, first, count, now);
    // No branch: there is no pattern in who touches.
    for (std::size_t k = 0; k < kLanes; ++k) {
      touching[found + k] = static_cast<std::uint32_t>(first) + kLanesOf[now][k];
    }
    found += kCountOf[now];
  }
  return found;
}

/// Looks up all that the contact of each touching pair of spheres depends on.
REPOSE_INLINE void look_up(const ContactStep& step, NeighbourList& list, std::size_t first,
                           std::span<const std::uint32_t> found, std::span<PairLoad> loads,
                           TouchingPair* pairs, std::span<TouchingSpheres> touching) {
  const Bodies& bodies = step.bodies;
  for (PairLoad& load : loads) load.overlap = 0;
  int last_pair = -1;
  TouchingPair* shared = nullptr;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const NearSpheres& near = list.spheres[found[k]];
    if (shared == nullptr || near.pair != last_pair) {
      last_pair = near.pair;
      const NearGrains& pair = list.grains[static_cast<std::size_t>(near.pair)];
      const auto a = static_cast<std::size_t>(pair.a);
      const auto b = static_cast<std::size_t>(pair.b);
      PairLoad& load = loads[static_cast<std::size_t>(near.pair) - first];
      load = {};
      // Bodies b lie anywhere in memory: asked for now, they are here when the contacts are worked
      // out.
      __builtin_prefetch(&bodies.motion[b].velocity);
      __builtin_prefetch(&bodies.motion[b].spin_kick);
      __builtin_prefetch(&bodies.load[b]);
      shared = pairs++;
      *shared = {&bodies.motion[a],
                 &bodies.motion[b],
                 &bodies.position[a],
                 &bodies.position[b],
                 &step.contacts.law(step.material(pair.a), step.material(pair.b)),
                 &load};
    }
    shared->load->touching += 1;
    touching[k] = {shared, &bodies.spheres[static_cast<std::size_t>(near.a)],
                   &bodies.spheres[static_cast<std::size_t>(near.b)], &list.memories[found[k]]};
  }
}

}  // namespace

REPOSE_FOR_EACH_MACHINE
void find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t first,
                     std::span<PairLoad> loads) {
  // Kept from call to call, so that nothing is allocated once they are large enough.
  thread_local std::vector<std::uint32_t> found;
  thread_local std::vector<TouchingPair> pairs;
  thread_local std::vector<TouchingSpheres> touching;
  const auto from = static_cast<std::size_t>(list.grains[first].first);
  const NearGrains& last = list.grains[first + loads.size() - 1];
  const auto to = static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count);
  found.resize(std::max(found.size(), to - from + kLanes));
  pairs.resize(std::max(pairs.size(), loads.size()));
  const std::size_t count = find_touching(step, list, from, to, found.data());
  touching.resize(std::max(touching.size(), count));
  const std::span<TouchingSpheres> all{touching.data(), count};
  look_up(step, list, first, {found.data(), count}, loads, pairs.data(), all);
  add_contacts<PlacedSphere>(all, step);
}

}  // namespace repose::dem
