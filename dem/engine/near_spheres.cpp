#include "dem/engine/near_spheres.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstring>

#include "dem/engine/lanes.h"
#include "dem/engine/parallel.h"

namespace repose::dem {

namespace {

/// Margin of a grain at rest, as a fraction of its bounding radius.
constexpr double kRestMargin = .001;
/// A moving grain's margin lasts for about this many steps ...
constexpr double kHorizonSteps = 20;
/// ... but is at most this fraction of its bounding radius.
constexpr double kGreatestMargin = .6;

using Orientations = std::array<std::vector<double>, 4>;

/// Squared distance between corresponding rows, for four of them.
REPOSE_INLINE Double4 distance2(const Row* from, const Row* to) {
  return gather([&](std::size_t k) { return load_row(to[k]) - load_row(from[k]); })
      .xyz.squared_norm();
}

/// For which of four bodies spheres can have moved farther than a share of the margin, by
/// translation and rotation.
REPOSE_INLINE LaneMask have_used(double share, const Bodies& bodies, const Row* position,
                                 const Orientations& orientation, const double* margin,
                                 std::size_t k) {
  Double4 left = share * load(margin + k);
  if (!bodies.is_round) {
    Double4 turned;
    for (std::size_t i = 0; i < 4; ++i) {
      turned += load(&bodies.orientation[i][k]) * load(&orientation[i][k]);
    }
    const Double4 way = sqrt(max(Double4(0), 1 - turned * turned));
    left = left - 2 * load(&bodies.bounding_radius[k]) * way;
  }
  const LaneMask has_left =
      (left <= Double4(0)) | (distance2(position + k, &bodies.position[k]) > left * left);
  return has_left & (load(&bodies.presence[k]) > Double4(0));
}

REPOSE_TARGET_CLONES
bool any_has_used(double share, const Bodies& bodies, const Row* position,
                  const Orientations& orientation, const double* margin, const Chunk& chunk) {
  for (std::size_t k = chunk.first; k < chunk.end; k += kLanes) {
    if (any(have_used(share, bodies, position, orientation, margin, k))) return true;
  }
  return false;
}

REPOSE_TARGET_CLONES
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

void CellGrid::choose_cells(const Bodies& bodies) {
  Vector low = Vector::Constant(1e300);
  Vector high = Vector::Constant(-1e300);
  double widest = 0;
  std::size_t present = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    ++present;
    low = low.cwiseMin(place_[k].xyz);
    high = high.cwiseMax(place_[k].xyz);
    widest = std::max(widest, place_[k].w);
  }
  if (present == 0) low = high = Vector::Zero();
  corner_ = low;
  cell_size_ = std::max(2 * widest, 1e-12);
  // Stray grains far away must not create far more cells than grains.
  const Vector extent = high - low;
  const double max_cells = 8.0 * static_cast<double>(present) + 64;
  const auto cells_at = [&extent](double size) {
    return ((extent.array() / size).floor() + 1).matrix().eval();
  };
  while (cells_at(cell_size_).prod() > max_cells) cell_size_ *= 1.3;
  cells_ = cells_at(cell_size_).cast<int>();
  cell_bodies_.resize(present);
}

void CellGrid::sort(const Bodies& bodies, const Margins& margins) {
  place_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto body = static_cast<int>(k);
    place_[k] = {.xyz = margins.position(body).xyz,
                 .w = bodies.bounding_radius[k] + margins.margin_m(body)};
  }
  choose_cells(bodies);
  cell_of_.assign(bodies.size(), -1);
  cell_start_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    const Eigen::Vector3i at =
        ((place_[k].xyz - corner_) / cell_size_).array().floor().cast<int>().matrix();
    cell_of_[k] = (at.z() * cells_.y() + at.y()) * cells_.x() + at.x();
    ++cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  for (std::size_t k = bodies.size(); k-- > 0;) {
    if (cell_of_[k] < 0) continue;
    auto& end = cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
    cell_bodies_[static_cast<std::size_t>(--end)] = static_cast<int>(k);
  }
  // Filled from the back, every entry now holds its cell's start, shifted by one.
  cell_start_.erase(cell_start_.begin());
  cell_start_.push_back(static_cast<int>(cell_bodies_.size()));
}

void CellGrid::add_near(int body, std::vector<int>& near) const {
  const auto k = static_cast<std::size_t>(body);
  const int cell = cell_of_[k];
  const int x = cell % cells_.x();
  const int y = cell / cells_.x() % cells_.y();
  const int z = cell / (cells_.x() * cells_.y());
  const int from_x = std::max(x - 1, 0);
  const int to_x = std::min(x + 1, cells_.x() - 1);
  for (int cz = std::max(z - 1, 0); cz <= std::min(z + 1, cells_.z() - 1); ++cz) {
    for (int cy = std::max(y - 1, 0); cy <= std::min(y + 1, cells_.y() - 1); ++cy) {
      const int row = (cz * cells_.y() + cy) * cells_.x();
      const auto first = static_cast<std::size_t>(row) + static_cast<std::size_t>(from_x);
      const auto last = static_cast<std::size_t>(row) + static_cast<std::size_t>(to_x);
      for (int at = cell_start_[first]; at < cell_start_[last + 1]; ++at) {
        const int other = cell_bodies_[static_cast<std::size_t>(at)];
        if (other == body) continue;
        const Row& place = place_[static_cast<std::size_t>(other)];
        const double reach = place_[k].w + place.w;
        if ((place.xyz - place_[k].xyz).squaredNorm() < reach * reach) near.push_back(other);
      }
    }
  }
}

namespace {

/// Spheres per vector: all those of most clumps.
constexpr std::size_t kTogether = 16;
using Floats = float __attribute__((vector_size(64)));
using Ints16 = int __attribute__((vector_size(64)));
using Ints8 = int __attribute__((vector_size(32)));
using Ints4 = int __attribute__((vector_size(16)));

/// As a fraction of both grains' reach: exceeds the rounding error of a distance between their
/// spheres. Differences are rounded once to 2^-24, then squares and sums, each of at most twice
/// that reach.
constexpr double kRounding = 1e-6;

REPOSE_INLINE Floats load_floats(const float* from) {
  Floats numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

/// A bit per lane, the first lane's lowest.
REPOSE_INLINE unsigned bits_of_all(const Ints16& mask) {
  const Ints16 bits =
      mask & Ints16{1,      1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                    1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
  const Ints8 eight = __builtin_shufflevector(bits, bits, 0, 1, 2, 3, 4, 5, 6, 7) |
                      __builtin_shufflevector(bits, bits, 8, 9, 10, 11, 12, 13, 14, 15);
  const Ints4 four = __builtin_shufflevector(eight, eight, 0, 1, 2, 3) |
                     __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
  const Ints4 two = four | __builtin_shufflevector(four, four, 2, 3, 0, 1);
  return static_cast<unsigned>(two[0] | two[1]);
}

/// Spheres from `first` to `end` - 1, with the arrays of their positions and radii.
struct SphereRange {
  std::array<const float*, 3> offset;
  const float* radius;
  std::size_t first;
  std::size_t end;
};

/// Calls visit(number) for each sphere whose surface is less than `reach` from a point, which is
/// relative to the body's centre.
template <typename Visit>
REPOSE_INLINE void for_each_within(const SphereRange& spheres, const std::array<float, 3>& point,
                                   float reach, const Visit& visit) {
  for (std::size_t k = spheres.first; k < spheres.end; k += kTogether) {
    const Floats x = load_floats(spheres.offset[0] + k) - point[0];
    const Floats y = load_floats(spheres.offset[1] + k) - point[1];
    const Floats z = load_floats(spheres.offset[2] + k) - point[2];
    const Floats far = load_floats(spheres.radius + k) + reach;
    unsigned bits = bits_of_all(x * x + y * y + z * z < far * far);
    if (k + kTogether > spheres.end) bits &= (1U << (spheres.end - k)) - 1;
    for (; bits != 0; bits &= bits - 1) {
      visit(k + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
}

REPOSE_TARGET_CLONES
void add_pairs(SphereRange of_a, SphereRange of_b, const Vector& from_a_to_b, double reach_b,
               double margin, std::vector<NearSpheres>& near) {
  const std::array<float, 3> apart = {static_cast<float>(from_a_to_b.x()),
                                      static_cast<float>(from_a_to_b.y()),
                                      static_cast<float>(from_a_to_b.z())};
  const auto margin_f = static_cast<float>(margin);
  for_each_within(of_a, apart, static_cast<float>(reach_b) + margin_f, [&](std::size_t a) {
    const std::array<float, 3> point = {of_a.offset[0][a] - apart[0], of_a.offset[1][a] - apart[1],
                                        of_a.offset[2][a] - apart[2]};
    for_each_within(of_b, point, of_a.radius[a] + margin_f, [&](std::size_t b) {
      near.push_back({.a = static_cast<int>(a), .b = static_cast<int>(b)});
    });
  });
}

}  // namespace

void SphereColumns::resize(std::size_t spheres) {
  for (auto& numbers : offset_) numbers.resize(spheres + kTogether);
  radius_.resize(spheres + kTogether);
}

void SphereColumns::take_in(const Bodies& bodies, std::size_t body) {
  const auto end = static_cast<std::size_t>(bodies.first_sphere[body + 1]);
  for (auto k = static_cast<std::size_t>(bodies.first_sphere[body]); k < end; ++k) {
    const Vector offset = bodies.spheres[k].centre - bodies.position[body].xyz;
    for (int axis = 0; axis < 3; ++axis) {
      offset_[static_cast<std::size_t>(axis)][k] = static_cast<float>(offset[axis]);
    }
    radius_[k] = static_cast<float>(bodies.spheres[k].radius);
  }
}

void SphereColumns::add_near(const Bodies& bodies, const Margins& margins, int a, int b,
                             std::vector<NearSpheres>& near) const {
  const auto range = [&](int body) {
    const auto k = static_cast<std::size_t>(body);
    return SphereRange{.offset = {offset_[0].data(), offset_[1].data(), offset_[2].data()},
                       .radius = radius_.data(),
                       .first = static_cast<std::size_t>(bodies.first_sphere[k]),
                       .end = static_cast<std::size_t>(bodies.first_sphere[k + 1])};
  };
  const double reach_b = bodies.bounding_radius[static_cast<std::size_t>(b)];
  const double reach = bodies.bounding_radius[static_cast<std::size_t>(a)] + reach_b;
  add_pairs(range(a), range(b), margins.position(b).xyz - margins.position(a).xyz, reach_b,
            margins.margin_m(a) + margins.margin_m(b) + kRounding * reach, near);
}

}  // namespace repose::dem
