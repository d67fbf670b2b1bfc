#include "dem/engine/wall_contacts.h"

#include <utility>

namespace repose::dem {
namespace {

using TouchingWall = Touching<FacetContact>;

const PlacedSphere& sphere_of(const ContactStep& step, const NeighbourList& list, std::size_t k) {
  return step.bodies.spheres[static_cast<std::size_t>(list.facets[k].sphere)];
}

FacetContact facet_contact(const ContactStep& step, const NearWall& pair, const NeighbourList& list,
                           std::size_t k) {
  return step.walls.contact(pair.wall, list.facets[k].facet, sphere_of(step, list, k).centre);
}

/// A sphere that moves on to the next facet of a wall takes its contact's memory along.
void hand_over_memories(const ContactStep& step, const NearWall& pair, NeighbourList& list) {
  const auto touches = [&](std::size_t k) {
    return facet_contact(step, pair, list, k).distance < sphere_of(step, list, k).radius;
  };
  auto first = static_cast<std::size_t>(pair.first);
  const std::size_t end = first + static_cast<std::size_t>(pair.count);
  while (first < end) {
    std::size_t last = first + 1;
    while (last < end && list.facets[last].sphere == list.facets[first].sphere) ++last;
    for (std::size_t from = first; from < last; ++from) {
      if (list.wall_memories[from].radius == 0 || touches(from)) continue;
      for (std::size_t to = first; to < last; ++to) {
        if (list.wall_memories[to].radius > 0 || !touches(to)) continue;
        std::swap(list.wall_memories[to], list.wall_memories[from]);
        break;
      }
    }
    first = last;
  }
}

/// Adds what touches. What has parted forgets.
void add_touching(const ContactStep& step, const WallMotions& wall_motions, const NearWall& pair,
                  NeighbourList& list, FacetContact* facets, PairLoad* load, TouchingPair* shared,
                  std::vector<TouchingWall>& touching) {
  if (step.walls.has_facets(pair.wall)) hand_over_memories(step, pair, list);
  const std::size_t start = touching.size();
  for (int near = 0; near < pair.count; ++near) {
    const auto k = static_cast<std::size_t>(pair.first) + static_cast<std::size_t>(near);
    const PlacedSphere& sphere = sphere_of(step, list, k);
    ContactMemory& memory = list.wall_memories[k];
    *facets = facet_contact(step, pair, list, k);
    if (facets->distance < sphere.radius) {
      touching.push_back({shared, &sphere, facets++, &memory});
    } else if (memory.radius > 0) {
      memory = {};
    }
  }
  if (touching.size() == start) return;
  const auto body = static_cast<std::size_t>(pair.body);
  const auto wall = static_cast<std::size_t>(pair.wall);
  *shared = {&step.bodies.motion[body],
             &wall_motions.motion[wall],
             &step.bodies.position[body],
             &wall_motions.position[wall],
             &step.contacts.law(step.material(pair.body), step.walls.wall(pair.wall).material),
             load};
  load->touching = static_cast<double>(touching.size() - start);
}

REPOSE_FOR_EACH_MACHINE
void add_wall_contacts(std::span<const TouchingWall> touching, const ContactStep& step) {
  add_contacts<FacetContact>(touching, step);
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

void find_wall_loads(const ContactStep& step, const WallMotions& wall_motions, NeighbourList& list,
                     std::size_t first, std::span<PairLoad> loads) {
  // Kept from call to call, so that nothing is allocated once they are large enough.
  thread_local std::vector<FacetContact> facets;
  thread_local std::vector<TouchingPair> pairs;
  thread_local std::vector<TouchingWall> touching;
  pairs.resize(std::max(pairs.size(), loads.size()));
  std::fill(loads.begin(), loads.end(), PairLoad{});
  const auto from = static_cast<std::size_t>(list.walls[first].first);
  const NearWall& last = list.walls[first + loads.size() - 1];
  facets.resize(std::max(facets.size(), static_cast<std::size_t>(last.first) +
                                            static_cast<std::size_t>(last.count) - from));
  touching.clear();
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const NearWall& pair = list.walls[first + k];
    add_touching(step, wall_motions, pair, list,
                 &facets[static_cast<std::size_t>(pair.first) - from], &loads[k], &pairs[k],
                 touching);
  }
  add_wall_contacts(touching, step);
}

}  // namespace repose::dem
