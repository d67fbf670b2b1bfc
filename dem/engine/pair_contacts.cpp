#include "dem/engine/pair_contacts.h"

#include <vector>

namespace repose::dem {
namespace {

using TouchingSpheres = Touching<PlacedSphere>;

/// Lists which of the near spheres from ... to - 1 touch. What has parted forgets.
/// @return how many do
REPOSE_INLINE std::size_t find_touching(const ContactStep& step, NeighbourList& list,
                                        std::size_t from, std::size_t to, std::size_t* touching) {
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
    const auto old_radius = [&](std::size_t lane) {
      return list.memories[std::min(first + lane, to - 1)].radius;
    };
    const LaneMask parted = select(touches, Lanes(0), each(old_radius)) > Lanes(0);
    const std::size_t count = std::min(kLanes, to - first);
    for (std::size_t lane = 0; any(parted) && lane < count; ++lane) {
      if (parted[lane]) list.memories[first + lane] = {};
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      touching[found] = first + lane;
      found += touches[lane] ? 1 : 0;  // no branch: there is no pattern in who touches
    }
  }
  return found;
}

/// Looks up all that the contact of each touching pair of spheres depends on.
REPOSE_INLINE void look_up(const ContactStep& step, NeighbourList& list, std::size_t first,
                           std::span<const std::size_t> found, std::span<PairLoad> loads,
                           std::span<TouchingSpheres> touching) {
  const Bodies& bodies = step.bodies;
  for (PairLoad& load : loads) load.overlap = 0;
  int last_pair = -1;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const NearSpheres& near = list.spheres[found[k]];
    const NearGrains& pair = list.grains[static_cast<std::size_t>(near.pair)];
    PairLoad& load = loads[static_cast<std::size_t>(near.pair) - first];
    if (near.pair != last_pair) load = {};
    last_pair = near.pair;
    load.touching += 1;
    TouchingSpheres& one = touching[k];  // filled in place: copies would cost more
    one.a = &bodies.motion[static_cast<std::size_t>(pair.a)];
    one.b = &bodies.motion[static_cast<std::size_t>(pair.b)];
    one.position_a = &bodies.position[static_cast<std::size_t>(pair.a)];
    one.position_b = &bodies.position[static_cast<std::size_t>(pair.b)];
    // Bodies b lie anywhere in memory: asked for now, they are here when the contacts are worked
    // out.
    __builtin_prefetch(&one.b->velocity);
    __builtin_prefetch(&one.b->spin_kick);
    __builtin_prefetch(&bodies.load[static_cast<std::size_t>(pair.b)]);
    one.sphere = &bodies.spheres[static_cast<std::size_t>(near.a)];
    one.other = &bodies.spheres[static_cast<std::size_t>(near.b)];
    one.memory = &list.memories[found[k]];
    one.load = &load;
    one.law = &step.contacts.law(step.material(pair.a), step.material(pair.b));
  }
}

}  // namespace

REPOSE_FOR_EACH_MACHINE
void find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t first,
                     std::span<PairLoad> loads) {
  // Kept from call to call, so that nothing is allocated once they are large enough.
  thread_local std::vector<std::size_t> found;
  thread_local std::vector<TouchingSpheres> touching;
  const auto from = static_cast<std::size_t>(list.grains[first].first);
  const NearGrains& last = list.grains[first + loads.size() - 1];
  const auto to = static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count);
  found.resize(std::max(found.size(), to - from));
  const std::size_t count = find_touching(step, list, from, to, found.data());
  touching.resize(std::max(touching.size(), count));
  const std::span<TouchingSpheres> all{touching.data(), count};
  look_up(step, list, first, {found.data(), count}, loads, all);
  add_contacts<PlacedSphere>(all, step);
}

}  // namespace repose::dem
