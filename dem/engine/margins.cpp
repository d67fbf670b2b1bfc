#include "dem/engine/margins.h"

#include <algorithm>
#include <atomic>

#include "dem/engine/parallel.h"

namespace repose::dem {
namespace {

/// Margin of a grain at rest, as a fraction of its reach.
constexpr double kRestMargin = .001;
/// A moving grain's margin lasts for about so many steps ...
constexpr double kHorizonSteps = 20;
/// ... but is at most this fraction of its reach.
constexpr double kGreatestMargin = .6;

using Orientations = std::array<std::vector<double>, 4>;

/// Distance from one of four rows to the other, squared.
REPOSE_INLINE Lanes distance2(const Row* from, const Row* to) {
  return gather([&](std::size_t k) { return load_row(to[k]) - load_row(from[k]); })
      .xyz.squared_norm();
}

/// Which of four bodies' spheres can have come farther than a share of their margins, by moving and
/// by turning.
REPOSE_INLINE LaneMask have_used(double share, const Bodies& bodies, const Row* position,
                                 const Orientations& orientation, const double* margin,
                                 std::size_t k) {
  Lanes left = share * load(margin + k);
  if (!bodies.is_round) {
    Lanes turned;
    for (std::size_t i = 0; i < 4; ++i) {
      turned += load(&bodies.orientation[i][k]) * load(&orientation[i][k]);
    }
    const Lanes way = sqrt(greatest(Lanes(0), 1 - turned * turned));
    left = left - 2 * load(&bodies.bounding_radius[k]) * way;
  }
  const LaneMask has_left =
      (left <= Lanes(0)) | (distance2(position + k, &bodies.position[k]) > left * left);
  return has_left & (load(&bodies.presence[k]) > Lanes(0));
}

REPOSE_FOR_EACH_MACHINE
bool any_has_used(double share, const Bodies& bodies, const Row* position,
                  const Orientations& orientation, const double* margin, const Chunk& chunk) {
  for (std::size_t k = chunk.first; k < chunk.end; k += kLanes) {
    if (any(have_used(share, bodies, position, orientation, margin, k))) return true;
  }
  return false;
}

REPOSE_FOR_EACH_MACHINE
void note_used(double share, const Bodies& bodies, const Row* position,
               const Orientations& orientation, const double* margin, const Chunk& chunk,
               std::vector<std::uint8_t>& is_used) {
  for (std::size_t k = chunk.first; k < chunk.end; k += kLanes) {
    const LaneMask now = have_used(share, bodies, position, orientation, margin, k);
    for (std::size_t lane = 0; lane < std::min(kLanes, chunk.end - k); ++lane) {
      is_used[k + lane] = now[lane] ? 1 : 0;
    }
  }
}

}  // namespace

void Margins::resize(const Bodies& bodies) {
  const std::size_t size = bodies.presence.size();
  position_.resize(size);
  for (auto& numbers : orientation_) numbers.resize(size);
  margin_.resize(size);
}

void Margins::renew(const Bodies& bodies, std::size_t body, double timestep_s) {
  position_[body] = bodies.position[body];
  for (std::size_t k = 0; k < 4; ++k) orientation_[k][body] = bodies.orientation[k][body];
  const double reach = bodies.bounding_radius[body];
  const double turning = bodies.is_round ? 0 : reach * bodies.motion[body].spin.xyz.norm();
  const double speed = bodies.velocity[body].norm() + turning;
  margin_[body] =
      reach * std::min(kGreatestMargin, kRestMargin + kHorizonSteps * timestep_s * speed / reach);
}

bool Margins::is_used_up(const Bodies& bodies, int threads) const {
  std::atomic<bool> is_used_up = false;
  for_each_chunk(bodies.size(), kLookedAtTogether, threads, [&](const Chunk& chunk) {
    if (!is_used_up &&
        any_has_used(1, bodies, position_.data(), orientation_, margin_.data(), chunk)) {
      is_used_up = true;
    }
  });
  return is_used_up;
}

void Margins::note_half_used(const Bodies& bodies, std::vector<std::uint8_t>& is_half_used,
                             int threads) const {
  constexpr double kHalf = .5;
  is_half_used.resize(bodies.size());
  for_each_chunk(bodies.size(), kLookedAtTogether, threads, [&](const Chunk& chunk) {
    note_used(kHalf, bodies, position_.data(), orientation_, margin_.data(), chunk, is_half_used);
  });
}

}  // namespace repose::dem
