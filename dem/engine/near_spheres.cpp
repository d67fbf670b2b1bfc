#include "dem/engine/near_spheres.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "dem/engine/lanes.h"

namespace repose::dem {
namespace {

/// Most clumps' spheres at once.
constexpr std::size_t kTogether = 16;
using Floats = float __attribute__((vector_size(64)));
using Ints16 = int __attribute__((vector_size(64)));
using Ints8 = int __attribute__((vector_size(32)));
using Ints4 = int __attribute__((vector_size(16)));

/// Of the reach of both grains: more than rounding can take from a distance between their spheres.
/// Differences are rounded once to 2^-24, then squares and sums, each of at most twice that reach.
constexpr double kRounding = 1e-6;

REPOSE_INLINE Floats load_floats(const float* from) {
  Floats numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

/// A bit for each lane, the first one's lowest.
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

/// Spheres from `first` to `end` - 1, with the arrays that tell where they are.
struct SphereRange {
  std::array<const float*, 3> offset;
  const float* radius;
  std::size_t first;
  std::size_t end;
};

/// Calls visit(number) for each whose surface is less than `reach` from a point, seen from their
/// body's centre.
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

REPOSE_FOR_EACH_MACHINE
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
