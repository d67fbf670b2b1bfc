#include "dem/engine/interactions.h"

#include <algorithm>
#include <span>

#include "dem/engine/parallel.h"

namespace repose::dem {
namespace {

REPOSE_INLINE void add_row(const Lanes& row, Row& sum) { store_row(load_row(sum) + row, sum); }

template <typename Pair>
REPOSE_INLINE void add_to_a(Bodies& bodies, const Pair& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.a)];
  add_row(load.force, sum.force);
  add_row(load.torque_a, sum.torque);
}

template <typename Pair>
REPOSE_INLINE void add_to_b(Bodies& bodies, const Pair& pair, const PairLoad& load) {
  BodyLoad& sum = bodies.load[static_cast<std::size_t>(pair.b)];
  add_row(load.force * Lanes(Lanes::Vector4{-1, -1, -1, 1}), sum.force);
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

REPOSE_FOR_EACH_MACHINE
void add_to_bodies(std::span<const TouchingPair> pairs, std::span<const PairLoad> loads,
                   Bodies& bodies) {
  for (const TouchingPair& pair : pairs) {
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
    for (const TouchingPair& pair : list.touching[chunk.number].pairs) {
      touches_[chunk.first + static_cast<std::size_t>(pair.number)] = 1;
    }
  });
  for_each_index(bodies.size(), threads, [&](std::size_t body) {
    const auto begin = static_cast<std::size_t>(list.body_start[body]);
    const auto end = static_cast<std::size_t>(list.body_start[body + 1]);
    for (std::size_t at = begin; at < end; ++at) {
      const auto k = static_cast<std::size_t>(list.body_pairs[at]);
      if (touches_[k] == 0) continue;
      const NearGrains& pair = list.grains[k];
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
