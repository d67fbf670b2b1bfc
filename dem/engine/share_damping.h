#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "dem/engine/contact_lanes.h"
#include "dem/engine/find_contacts.h"

/// Shared damping: each contact of a pair damps with its share of the reduced mass, by elastic
/// energy U,
///   D_i = c sqrt(S_i m* U_i / sum U_j),
/// c sqrt(S m* / N) for N equal ones. Together they are D = b sqrt(m*) F / sqrt(2 U), F and U the
/// sums, b = c sqrt(6/5), which restores the same whatever F(d) is (dem/THEORY.md, "Several
/// contacts at once"; Feng 2026, arXiv:2604.02533; for the cause Kodam et al. 2009, Chemical
/// Engineering Science 64, 3466). Of a contact in another direction U_j cos^2 counts. Proved by
/// SharedDamping.* and, in `repose verify`, "spheres one after another".
namespace repose::dem {

/// Adds the contact in a lane.
REPOSE_INLINE void add_energy(double energy, const Vec3<Lanes>& normals, std::size_t lane,
                              DirectedEnergy& sum) {
  const Vec3<double> n = {normals.x[lane], normals.y[lane], normals.z[lane]};
  sum.xx += energy * (n.x * n.x);
  sum.yy += energy * (n.y * n.y);
  sum.zz += energy * (n.z * n.z);
  sum.xy += energy * (n.x * n.y);
  sum.yz += energy * (n.y * n.z);
  sum.zx += energy * (n.z * n.x);
}

/// Hertz's, 8/15 E* sqrt(R* d) d^2, without the factor that is the same for all contacts of a pair.
REPOSE_INLINE Lanes elastic_energy(const Touch<Lanes>& touch) {
  return sqrt(touch.reduced_radius * touch.overlap) * (touch.overlap * touch.overlap);
}

/// Parallel contacts are those of several spheres: one sphere in the corner of a mesh, or among
/// glued grains, touches several things.
template <typename Other>
REPOSE_INLINE bool shares_damping(const TouchingPair& pair, const Bodies& bodies) {
  if (pair.touching < 2) return false;
  if constexpr (std::is_same_v<Other, PlacedSphere>) return true;
  const auto a = static_cast<std::size_t>(pair.a);
  return bodies.first_sphere[a + 1] - bodies.first_sphere[a] > 1;
}

/// Leaves to each contact the mass that it damps.
/// @param energies  of each pair; zero: it does not share
template <typename Other>
REPOSE_INLINE void share_damping(std::span<Four<Other>> fours, const TouchingPair* pairs,
                                 const std::vector<DirectedEnergy>& energies) {
  for (Four<Other>& four : fours) {
    const auto all = [&](double DirectedEnergy::*part) __attribute__((always_inline)) {
      return each([&](std::size_t k) {
        return energies[static_cast<std::size_t>(four.touching.pair[k] - pairs)].*part;
      });
    };
    Touch<Lanes>& touch = four.contacts.touch;
    const Vec3<Lanes>& n = touch.normal;
    const Lanes along =
        n.x * n.x * all(&DirectedEnergy::xx) + n.y * n.y * all(&DirectedEnergy::yy) +
        n.z * n.z * all(&DirectedEnergy::zz) +
        2 * (n.x * n.y * all(&DirectedEnergy::xy) + n.y * n.z * all(&DirectedEnergy::yz) +
             n.z * n.x * all(&DirectedEnergy::zx));
    const Lanes own = elastic_energy(touch);
    touch.reduced_mass =
        select(along > own, touch.reduced_mass * (own / along), touch.reduced_mass);
  }
}

}  // namespace repose::dem
