#include "dem/engine/interactions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "dem/engine/parallel.h"

namespace repose::dem {

namespace {

/// A byte of 1 or 0 per lane.
constexpr std::array<std::uint32_t, 16> kBytesOf = {
    0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001, 0x00010100, 0x00010101,
    0x01000000, 0x01000001, 0x01000100, 0x01000101, 0x01010000, 0x01010001, 0x01010100, 0x01010101};

/// Notes which of `count` near pairs of spheres from `first` on touch now. Clears the history of
/// those that have separated.
/// @return whether that has changed
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

/// Finds which of `count` near pairs of spheres from `first` on touch.
/// @return whether that has changed
REPOSE_INLINE bool look_at(const ContactStep& step, NeighbourList& list, std::size_t first,
                           std::size_t count) {
  const Double4 minus_w = Double4::Vector4{1, 1, 1, -1};
  const Columns apart = gather([&](std::size_t lane) {
    const NearSpheres& near = list.spheres[first + std::min(lane, count - 1)];
    const Double4 a = load_row(step.bodies.spheres[static_cast<std::size_t>(near.a)]);
    const Double4 b = load_row(step.bodies.spheres[static_cast<std::size_t>(near.b)]);
    return b - a * minus_w;  // w: the sum of the radii
  });
  const Double4 distance2 = apart.xyz.squared_norm();
  // Concentric spheres have no contact normal: the audit stops such a run.
  const LaneMask touches = (distance2 < apart.w * apart.w) & (distance2 > Double4(0));
  return note_touching(list, first, count, bits_of(touches) & ((1U << count) - 1));
}

/// Finds which of the near pairs of spheres from ... to - 1 touch.
/// @return whether that has changed
REPOSE_INLINE bool look_at_all(const ContactStep& step, NeighbourList& list, std::size_t from,
                               std::size_t to) {
  bool has_changed = false;
  std::size_t first = from;
  for (; first + kLanes <= to; first += kLanes) has_changed |= look_at(step, list, first, kLanes);
  if (first < to) has_changed |= look_at(step, list, first, to - first);
  return has_changed;
}

ActivePair touching_pair(const ContactStep& step, const NeighbourPair& near, std::size_t number,
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

Sides<PlacedSphere> sides_of(const Bodies& bodies, std::vector<ContactHistory>& memories) {
  return {.spheres = bodies.spheres.data(),
          .others = bodies.spheres.data(),
          .memories = memories.data(),
          .motions_a = bodies.motion.data(),
          .motions_b = bodies.motion.data(),
          .positions_a = bodies.position.data(),
          .positions_b = bodies.position.data()};
}

/// Looks up which of the pairs from `first` on touch, and what their contacts share.
void look_up(const ContactStep& step, const NeighbourList& list, std::size_t first,
             std::size_t count, TouchingChunk& chunk) {
  chunk.pairs.clear();
  chunk.contacts.clear();
  for (std::size_t number = 0; number < count; ++number) {
    const NeighbourPair& near = list.grains[first + number];
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

REPOSE_TARGET_CLONES
bool have_changed(const ContactStep& step, NeighbourList& list, std::size_t from, std::size_t to) {
  return look_at_all(step, list, from, to);
}

REPOSE_TARGET_CLONES
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
  const NeighbourPair& last = list.grains[first + loads.size() - 1];
  TouchingChunk& chunk = list.touching[number];
  if (have_changed(step, list, static_cast<std::size_t>(list.grains[first].first),
                   static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count)) ||
      !chunk.is_known) {
    look_up(step, list, first, loads.size(), chunk);
  }
  return add_pair_contacts(chunk, sides_of(step.bodies, list.memories), step, work, loads.data());
}

namespace {

/// Whether entry `k` of the near facets touches, and where.
bool touches(const ContactStep& step, const NearWall& pair, const NeighbourList& list,
             std::size_t k, FacetContact& where) {
  const NearFacet& near = list.facets[k];
  const PlacedSphere& sphere = step.bodies.spheres[static_cast<std::size_t>(near.sphere)];
  return step.walls.touches(pair.wall, near.facet, sphere.centre, sphere.radius, where);
}

/// A sphere that moves on to another facet of a wall keeps its contact history.
void hand_over_memories(const ContactStep& step, const NearWall& pair, NeighbourList& list) {
  FacetContact where;
  auto first = static_cast<std::size_t>(pair.first);
  const std::size_t end = first + static_cast<std::size_t>(pair.count);
  while (first < end) {
    std::size_t last = first + 1;
    while (last < end && list.facets[last].sphere == list.facets[first].sphere) ++last;
    for (std::size_t from = first; from < last; ++from) {
      if (list.wall_memories[from].radius == 0 || touches(step, pair, list, from, where)) continue;
      for (std::size_t to = first; to < last; ++to) {
        if (list.wall_memories[to].radius > 0 || !touches(step, pair, list, to, where)) continue;
        std::swap(list.wall_memories[to], list.wall_memories[from]);
        break;
      }
    }
    first = last;
  }
}

/// Active contacts of some grains with walls.
struct TouchingWalls {
  std::vector<FacetContact> facets;
  std::vector<ActivePair> pairs;
  std::vector<ActiveContact> contacts;
  ContactWork<FacetContact> work;
};

ActivePair touching_pair(const ContactStep& step, const NearWall& near, std::size_t number,
                         std::size_t touching) {
  const BodyMotion& motion = step.bodies.motion[static_cast<std::size_t>(near.body)];
  const double mass = motion.spin.w;
  return {.a = near.body,
          .b = near.wall,
          .law = &step.contacts.law(step.material(near.body), step.walls.wall(near.wall).material),
          .number = static_cast<int>(number),
          .touching = static_cast<int>(touching),
          .reduced_mass = mass,
          .damper_limit = damper_limit(mass, step.timestep_s, static_cast<double>(touching))};
}

Sides<FacetContact> sides_of(const Bodies& bodies, const WallMotions& wall_motions,
                             const std::vector<FacetContact>& facets,
                             std::vector<ContactHistory>& memories) {
  return {.spheres = bodies.spheres.data(),
          .others = facets.data(),
          .memories = memories.data(),
          .motions_a = bodies.motion.data(),
          .motions_b = wall_motions.motion.data(),
          .positions_a = bodies.position.data(),
          .positions_b = wall_motions.position.data()};
}

/// Adds active contacts, clears the history of those that have separated.
void add_touching(const ContactStep& step, const NearWall& near, std::size_t number,
                  NeighbourList& list, TouchingWalls& touching) {
  if (step.walls.has_facets(near.wall)) hand_over_memories(step, near, list);
  const std::size_t start = touching.contacts.size();
  for (int k = near.first; k < near.first + near.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    ContactHistory& memory = list.wall_memories[at];
    FacetContact& facet = touching.facets[touching.contacts.size()];
    if (touches(step, near, list, at, facet)) {
      touching.contacts.push_back({.sphere = list.facets[at].sphere,
                                   .other = static_cast<int>(touching.contacts.size()),
                                   .memory = k,
                                   .pair = static_cast<int>(touching.pairs.size())});
    } else if (memory.radius > 0) {
      memory = {};
    }
  }
  const std::size_t found = touching.contacts.size() - start;
  if (found > 0) touching.pairs.push_back(touching_pair(step, near, number, found));
}

REPOSE_TARGET_CLONES
double add_wall_contacts(TouchingWalls& touching, const Sides<FacetContact>& sides,
                         const ContactStep& step, PairLoad* loads) {
  // Few contacts are with walls: the gain from is_round is not worth compiling everything again.
  return add_contacts<false>(touching.contacts, touching.pairs, sides, step, touching.work, loads);
}

}  // namespace

void find_wall_motions(const WallSet& walls, WallMotions& motions) {
  motions.position.resize(static_cast<std::size_t>(walls.size()));
  motions.motion.resize(motions.position.size());
  for (int k = 0; k < walls.size(); ++k) {
    const WallMoment& moment = walls.moment(k);
    const Vector& position = moment.pose.position;
    motions.position[static_cast<std::size_t>(k)].xyz = position;
    motions.motion[static_cast<std::size_t>(k)] = {
        .velocity = {.xyz = moment.velocity_at(position)},
        .spin = {.xyz = moment.spin},
        .velocity_kick = {},
        .spin_kick = {}};
  }
}

double find_wall_loads(const ContactStep& step, const WallMotions& wall_motions,
                       NeighbourList& list, std::size_t first, std::span<PairLoad> loads) {
  // Kept between calls, so that nothing is allocated once large enough.
  thread_local TouchingWalls touching;
  const auto from = static_cast<std::size_t>(list.walls[first].first);
  const NearWall& last = list.walls[first + loads.size() - 1];
  const std::size_t near =
      static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count) - from;
  touching.facets.resize(std::max(touching.facets.size(), near));
  touching.work.motions.resize(std::max(touching.work.motions.size(), loads.size()));
  touching.pairs.clear();
  touching.contacts.clear();
  for (std::size_t k = 0; k < loads.size(); ++k) {
    loads[k].force = {};
    add_touching(step, list.walls[first + k], k, list, touching);
  }
  return add_wall_contacts(touching,
                           sides_of(step.bodies, wall_motions, touching.facets, list.wall_memories),
                           step, loads.data());
}

namespace {

REPOSE_INLINE void add_row(const Double4& row, Row& sum) { store_row(load_row(sum) + row, sum); }

template <typename Pair>
REPOSE_INLINE void add_to_a(Bodies& bodies, const Pair& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.a)];
  add_row(load.force, sum.force);
  add_row(load.torque_a, sum.torque);
}

template <typename Pair>
REPOSE_INLINE void add_to_b(Bodies& bodies, const Pair& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.b)];
  add_row(load.force * Double4(Double4::Vector4{-1, -1, -1, 1}), sum.force);
  add_row(load.torque_b, sum.torque);
}

/// Power that the wall's motion puts into the grain, W.
double power_of(const PairLoad& load, const BodyMotion& wall) {
  double power = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<int>(axis);
    power += load.force[axis] * wall.velocity.xyz[k] - load.torque_b[axis] * wall.spin.xyz[k];
  }
  return power;
}

REPOSE_TARGET_CLONES
void add_to_bodies(std::span<const ActivePair> pairs, std::span<const PairLoad> loads,
                   Bodies& bodies) {
  for (const ActivePair& pair : pairs) {
    const PairLoad& load = loads[static_cast<std::size_t>(pair.number)];
    add_to_a(bodies, pair, load);
    add_to_b(bodies, pair, load);
  }
}

}  // namespace

ContactTally Interactions::apply(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                                 int threads) {
  tally_ = {};
  apply_pairs(bodies, step, list, threads);
  apply_walls(bodies, step, list, threads);
  return tally_;
}

void Interactions::apply_pairs(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                               int threads) {
  const std::size_t pairs = list.grains.size();
  if (threads == 1) {
    loads_.resize(std::max(loads_.size(), kPairsTogether));
    for_each_chunk(pairs, kPairsTogether, threads, [&](const Chunk& chunk) {
      const std::span<PairLoad> loads = {loads_.data(), chunk.size()};
      const double deepest = find_pair_loads(step, list, chunk.number, loads);
      tally_.deepest_overlap = std::max(tally_.deepest_overlap, deepest);
      add_to_bodies(list.touching[chunk.number].pairs, loads, bodies);
    });
    return;
  }
  loads_.resize(std::max(loads_.size(), pairs));
  touches_.assign(pairs, 0);
  deepest_.assign(chunks_of(pairs, kPairsTogether), 0);
  for_each_chunk(pairs, kPairsTogether, threads, [&](const Chunk& chunk) {
    deepest_[chunk.number] =
        find_pair_loads(step, list, chunk.number, {&loads_[chunk.first], chunk.size()});
    for (const ActivePair& pair : list.touching[chunk.number].pairs) {
      touches_[chunk.first + static_cast<std::size_t>(pair.number)] = 1;
    }
  });
  for_each_index(bodies.size(), threads, [&](std::size_t body) {
    const auto begin = static_cast<std::size_t>(list.body_start[body]);
    const auto end = static_cast<std::size_t>(list.body_start[body + 1]);
    for (std::size_t at = begin; at < end; ++at) {
      const auto k = static_cast<std::size_t>(list.body_pairs[at]);
      if (touches_[k] == 0) continue;
      const NeighbourPair& pair = list.grains[k];
      if (pair.a == static_cast<int>(body)) {
        add_to_a(bodies, pair, loads_[k]);
      } else {
        add_to_b(bodies, pair, loads_[k]);
      }
    }
  });
  note_deepest();
}

void Interactions::note_deepest() {
  for (const double deepest : deepest_) {
    tally_.deepest_overlap = std::max(tally_.deepest_overlap, deepest);
  }
}

void Interactions::apply_walls(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                               int threads) {
  find_wall_motions(step.walls, wall_motions_);
  const std::size_t pairs = list.walls.size();
  loads_.resize(std::max(loads_.size(), pairs));
  deepest_.assign(chunks_of(pairs, kPairsTogether), 0);
  for_each_chunk(pairs, kPairsTogether, threads, [&](const Chunk& chunk) {
    deepest_[chunk.number] = find_wall_loads(step, wall_motions_, list, chunk.first,
                                             {&loads_[chunk.first], chunk.size()});
  });
  note_deepest();
  for (std::size_t k = 0; k < pairs; ++k) {
    const PairLoad& load = loads_[k];
    if (load.is_empty()) continue;
    BodyLoad& sum = bodies.load[static_cast<std::size_t>(list.walls[k].body)];
    add_row(load.force, sum.force);
    add_row(load.torque_a, sum.torque);
    tally_.wall_power_w +=
        power_of(load, wall_motions_.motion[static_cast<std::size_t>(list.walls[k].wall)]);
  }
}

}  // namespace repose::dem
