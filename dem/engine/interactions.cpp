#include "dem/engine/interactions.h"

#include <algorithm>
#include <span>

#include "dem/engine/parallel.h"

namespace repose::dem {
namespace {

/// Pairs worked on together: few enough for their loads to stay in the nearest cache.
constexpr std::size_t kChunk = 64;

REPOSE_INLINE void add_row(const Lanes& row, Row& sum) { store_row(load_row(sum) + row, sum); }

REPOSE_INLINE void add_to_a(Bodies& bodies, const NearGrains& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.a)];
  add_row(load.force, sum.force);
  add_row(load.torque_a, sum.torque);
}

REPOSE_INLINE void add_to_b(Bodies& bodies, const NearGrains& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.b)];
  add_row(-load.force, sum.force);
  add_row(load.torque_b, sum.torque);
}

/// What the wall's motion puts into the grain, W.
double power_of(const PairLoad& load, const BodyMotion& wall) {
  double power = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<int>(axis);
    power += load.force[axis] * wall.velocity.xyz[k] - load.torque_b[axis] * wall.spin.xyz[k];
  }
  return power;
}

/// Calls body(first, count) for chunks of up to kChunk.
template <typename Body>
void for_each_chunk(std::size_t size, int threads, const Body& body) {
  const auto chunk = [&](std::size_t k) { body(k * kChunk, std::min(kChunk, size - k * kChunk)); };
  for_each_index((size + kChunk - 1) / kChunk, threads, chunk, 1);
}

void note_overlap(double fraction, int body, ContactTally& tally) {
  if (fraction <= tally.deepest_overlap) return;
  tally.deepest_overlap = fraction;
  tally.deepest_body = body;
}

REPOSE_FOR_EACH_MACHINE
void add_loads(std::span<const NearGrains> pairs, std::span<const PairLoad> loads, Bodies& bodies,
               ContactTally& tally) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (loads[k].overlap == 0) continue;
    add_to_a(bodies, pairs[k], loads[k]);
    add_to_b(bodies, pairs[k], loads[k]);
    note_overlap(loads[k].overlap, pairs[k].a, tally);
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
    loads_.resize(std::max(loads_.size(), kChunk));
    for_each_chunk(pairs, threads, [&](std::size_t first, std::size_t count) {
      find_pair_loads(step, list, first, {loads_.data(), count});
      add_loads({&list.grains[first], count}, {loads_.data(), count}, bodies, tally_);
    });
    return;
  }
  loads_.resize(std::max(loads_.size(), pairs));
  for_each_chunk(pairs, threads, [&](std::size_t first, std::size_t count) {
    find_pair_loads(step, list, first, {&loads_[first], count});
  });
  for_each_index(bodies.size(), threads, [&](std::size_t body) {
    const auto begin = static_cast<std::size_t>(list.body_start[body]);
    const auto end = static_cast<std::size_t>(list.body_start[body + 1]);
    for (std::size_t at = begin; at < end; ++at) {
      const auto k = static_cast<std::size_t>(list.body_pairs[at]);
      if (loads_[k].overlap == 0) continue;
      const NearGrains& pair = list.grains[k];
      if (pair.a == static_cast<int>(body)) {
        add_to_a(bodies, pair, loads_[k]);
      } else {
        add_to_b(bodies, pair, loads_[k]);
      }
    }
  });
  for (std::size_t k = 0; k < pairs; ++k) {
    note_overlap(loads_[k].overlap, list.grains[k].a, tally_);
  }
}

void Interactions::apply_walls(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                               int threads) {
  find_wall_motions(step.walls, wall_motions_);
  const std::size_t pairs = list.walls.size();
  loads_.resize(std::max(loads_.size(), pairs));
  for_each_chunk(pairs, threads, [&](std::size_t first, std::size_t count) {
    find_wall_loads(step, wall_motions_, list, first, {&loads_[first], count});
  });
  for (std::size_t k = 0; k < pairs; ++k) {
    const PairLoad& load = loads_[k];
    if (load.overlap == 0) continue;
    BodyLoad& sum = bodies.load[static_cast<std::size_t>(list.walls[k].body)];
    add_row(load.force, sum.force);
    add_row(load.torque_a, sum.torque);
    tally_.wall_power_w +=
        power_of(load, wall_motions_.motion[static_cast<std::size_t>(list.walls[k].wall)]);
    note_overlap(load.overlap, list.walls[k].body, tally_);
  }
}

}  // namespace repose::dem
