#include "dem/engine/wall_contacts.h"

#include <utility>

namespace repose::dem {
namespace {

/// Whether number `k` of those listed near a wall touches, and where.
bool touches(const ContactStep& step, const NearWall& pair, const NeighbourList& list,
             std::size_t k, FacetContact& where) {
  const NearFacet& near = list.facets[k];
  const PlacedSphere& sphere = step.bodies.spheres[static_cast<std::size_t>(near.sphere)];
  return step.walls.touches(pair.wall, near.facet, sphere.centre, sphere.radius, where);
}

/// A sphere that moves on to the next facet of a wall takes its contact's memory along.
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

/// What touches, of some pairs.
struct TouchingWalls {
  std::vector<FacetContact> facets;
  std::vector<TouchingPair> pairs;
  std::vector<Touching> contacts;
  ContactWork<FacetContact> work;
};

TouchingPair touching_pair(const ContactStep& step, const NearWall& near, std::size_t number,
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
                             std::vector<ContactMemory>& memories) {
  return {.spheres = bodies.spheres.data(),
          .others = facets.data(),
          .memories = memories.data(),
          .motions_a = bodies.motion.data(),
          .motions_b = wall_motions.motion.data(),
          .positions_a = bodies.position.data(),
          .positions_b = wall_motions.position.data()};
}

/// Adds what touches. What has parted forgets.
void add_touching(const ContactStep& step, const NearWall& near, std::size_t number,
                  NeighbourList& list, TouchingWalls& touching) {
  if (step.walls.has_facets(near.wall)) hand_over_memories(step, near, list);
  const std::size_t start = touching.contacts.size();
  for (int k = near.first; k < near.first + near.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    ContactMemory& memory = list.wall_memories[at];
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

REPOSE_FOR_EACH_MACHINE
double add_wall_contacts(TouchingWalls& touching, const Sides<FacetContact>& sides,
                         const ContactStep& step, PairLoad* loads) {
  // Few contacts are with walls: what is_round saves is not worth compiling all once more.
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
  // Kept from call to call, so that nothing is allocated once they are large enough.
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

}  // namespace repose::dem
