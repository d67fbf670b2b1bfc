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
    for (std::size_t lane = 0; lane < std::min(kLanes, to - first); ++lane) {
      const std::size_t k = first + lane;
      if (!touches[lane] && list.memories[k].radius > 0) list.memories[k] = {};
      touching[found] = k;
      found += touches[lane] ? 1 : 0;  // no branch: there is no pattern in who touches
    }
  }
  return found;
}

/// Finds out which pair of grains each sphere pair belongs to.
void add_touching(const ContactStep& step, NeighbourList& list, std::size_t first,
                  std::span<const std::size_t> found, std::span<PairLoad> loads,
                  std::vector<TouchingSpheres>& touching) {
  const Bodies& bodies = step.bodies;
  std::size_t at = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const NearGrains& pair = list.grains[first + k];
    const auto end = static_cast<std::size_t>(pair.first) + static_cast<std::size_t>(pair.count);
    std::size_t last = at;
    while (last < found.size() && found[last] < end) ++last;
    const auto of_pair = static_cast<double>(last - at);
    if (at == last) continue;
    const ContactLaw& law = step.contacts.law(step.material(pair.a), step.material(pair.b));
    for (; at < last; ++at) {
      const NearSpheres& near = list.spheres[found[at]];
      TouchingSpheres& one = touching.emplace_back();  // filled in place: copies would cost more
      one.a = &bodies.motion[static_cast<std::size_t>(pair.a)];
      one.b = &bodies.motion[static_cast<std::size_t>(pair.b)];
      one.sphere = &bodies.spheres[static_cast<std::size_t>(near.a)];
      one.other = &bodies.spheres[static_cast<std::size_t>(near.b)];
      one.memory = &list.memories[found[at]];
      one.load = &loads[k];
      one.law = &law;
      one.of_pair = of_pair;
    }
  }
}

}  // namespace

REPOSE_FOR_EACH_MACHINE
void find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t first,
                     std::span<PairLoad> loads) {
  // Kept from call to call, so that nothing is allocated once they are large enough.
  thread_local std::vector<std::size_t> found;
  thread_local std::vector<TouchingSpheres> touching;
  std::fill(loads.begin(), loads.end(), PairLoad{});
  const auto from = static_cast<std::size_t>(list.grains[first].first);
  const NearGrains& last = list.grains[first + loads.size() - 1];
  const auto to = static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.count);
  found.resize(std::max(found.size(), to - from));
  touching.clear();
  const std::size_t count = find_touching(step, list, from, to, found.data());
  add_touching(step, list, first, {found.data(), count}, loads, touching);
  add_contacts<PlacedSphere>(touching, step.contacts.rolling(), step.timestep_s);
}

}  // namespace repose::dem
