#include "dem/engine/near_spheres.h"

#include <bit>
#include <cstddef>

#include "dem/engine/lanes.h"

namespace repose::dem {
namespace {

/// Spheres from `first` to `end` - 1, with the arrays that tell where they are.
struct SphereRange {
  const VectorArray& centre;
  const double* radius;
  std::size_t first;
  std::size_t end;
};

/// Calls visit(number) for each whose surface is less than `reach` from a point.
template <typename Visit>
REPOSE_INLINE void for_each_within(const SphereRange& spheres, const Vector& point, double reach,
                                   const Visit& visit) {
  for (std::size_t k = spheres.first; k < spheres.end; k += kLanes) {
    const Vec3<Lanes> apart = {load(spheres.centre.coordinate(0) + k) - point.x(),
                               load(spheres.centre.coordinate(1) + k) - point.y(),
                               load(spheres.centre.coordinate(2) + k) - point.z()};
    const Lanes far = reach + load(spheres.radius + k);
    unsigned bits = bits_of(apart.squared_norm() < far * far);
    if (k + kLanes > spheres.end) bits &= (1U << (spheres.end - k)) - 1;
    for (; bits != 0; bits &= bits - 1) {
      visit(k + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
}

REPOSE_FOR_EACH_MACHINE
void add_pairs(const SphereRange& of_a, const SphereRange& of_b, const Vector& centre_b,
               double reach_b, double margin, std::vector<NearSpheres>& near) {
  for_each_within(of_a, centre_b, reach_b + margin, [&](std::size_t a) {
    const Vector centre = of_a.centre[a];
    for_each_within(of_b, centre, of_a.radius[a] + margin, [&](std::size_t b) {
      near.push_back({.a = static_cast<int>(a), .b = static_cast<int>(b)});
    });
  });
}

}  // namespace

void SphereColumns::resize(std::size_t spheres) {
  centre_.resize(spheres + kLanes);
  radius_.resize(spheres + kLanes);
}

void SphereColumns::take_in(const Bodies& bodies, std::size_t body) {
  const auto end = static_cast<std::size_t>(bodies.first_sphere[body + 1]);
  for (auto k = static_cast<std::size_t>(bodies.first_sphere[body]); k < end; ++k) {
    centre_.set(k, bodies.spheres[k].centre);
    radius_[k] = bodies.spheres[k].radius;
  }
}

void SphereColumns::add_near(const Bodies& bodies, const Margins& margins, int a, int b,
                             std::vector<NearSpheres>& near) const {
  const auto range = [&](int body) {
    const auto k = static_cast<std::size_t>(body);
    return SphereRange{.centre = centre_,
                       .radius = radius_.data(),
                       .first = static_cast<std::size_t>(bodies.first_sphere[k]),
                       .end = static_cast<std::size_t>(bodies.first_sphere[k + 1])};
  };
  add_pairs(range(a), range(b), margins.position(b).xyz,
            bodies.bounding_radius[static_cast<std::size_t>(b)],
            margins.margin_m(a) + margins.margin_m(b), near);
}

}  // namespace repose::dem
