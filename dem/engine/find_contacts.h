#pragma once

#include "dem/engine/contact_lanes.h"
#include "dem/wall/wall_set.h"

/// The first pass of four contacts: where they are, and how they move.
namespace repose::dem {

/// From sphere to sphere; w: the sum of the radii.
REPOSE_INLINE Columns others_of(const FourTouching<PlacedSphere>& four) {
  const Lanes minus_w = Lanes::Vector4{1, 1, 1, -1};
  return gather([&](std::size_t k) {
    return load_row(*four.other[k]) - load_row(*four.sphere[k]) * minus_w;
  });
}

/// The facets' normals; w: how far they are.
REPOSE_INLINE Columns others_of(const FourTouching<FacetContact>& four) {
  return gather([&](std::size_t k) { return load_row(*four.other[k]); });
}

/// What depends on whether two spheres meet or a sphere and a wall: how deep, and reduced sizes.
REPOSE_INLINE void set_geometry(const FourTouching<PlacedSphere>& /*four*/, const Columns& apart,
                                const Lanes& radius, Contacts& c) {
  const Lanes distance = sqrt(apart.xyz.squared_norm());
  const Lanes other_radius = apart.w - radius;
  c.touch.normal = apart.xyz * (1 / distance);
  c.touch.overlap = apart.w - distance;
  c.touch.reduced_radius = radius * other_radius / apart.w;
  c.smaller_radius = least(radius, other_radius);
}

REPOSE_INLINE void set_geometry(const FourTouching<FacetContact>& four, const Columns& facet,
                                const Lanes& radius, Contacts& c) {
  const Lanes curvature = each([&](std::size_t k) { return four.other[k]->curvature; });
  c.touch.normal = -facet.xyz;
  c.touch.overlap = radius - facet.w;
  c.touch.reduced_radius = radius / (1 + radius * curvature);
  c.smaller_radius = radius / greatest(Lanes(1), radius * curvature);
}

template <typename Other>
REPOSE_INLINE Columns gather(const FourTouching<Other>& four, Row PairMotion::*row) {
  return gather([&](std::size_t k) { return load_row(four.motion[k]->*row); });
}

template <typename Other>
REPOSE_INLINE Motions motions_of(const FourTouching<Other>& four) {
  return {.apart = gather(four, &PairMotion::apart).xyz,
          .velocity = gather(four, &PairMotion::velocity),
          .spin = gather(four, &PairMotion::spin),
          .velocity_kick = gather(four, &PairMotion::velocity_kick),
          .spin_kick = gather(four, &PairMotion::spin_kick).xyz,
          .mean_spin = gather(four, &PairMotion::mean_spin).xyz};
}

/// BodyMotion, in lanes.
struct BodyMotions {
  Columns velocity;
  Columns spin;
  Vec3<Lanes> velocity_kick;
  Vec3<Lanes> spin_kick;

  template <typename MotionOfLane>
  REPOSE_INLINE explicit BodyMotions(const MotionOfLane& motion)
      : velocity(gather([&](std::size_t k) { return load_row(motion(k).velocity); })),
        spin(gather([&](std::size_t k) { return load_row(motion(k).spin); })),
        velocity_kick(gather([&](std::size_t k) { return load_row(motion(k).velocity_kick); }).xyz),
        spin_kick(gather([&](std::size_t k) { return load_row(motion(k).spin_kick); }).xyz) {}

  /// See contacts_per_kg(): a round grain's pair has one.
  REPOSE_INLINE Lanes contacts_per_kg() const { return greatest(Lanes(1), velocity.w) / spin.w; }
};

/// Of round grains, straight from the bodies: each pair has one contact, so that nothing is saved
/// by working it out once a pair. The same as set_motion().
REPOSE_INLINE Motions motions_of_round(const FourTouching<PlacedSphere>& four,
                                       const Sides<PlacedSphere>& sides, const Vec3<Lanes>& apart,
                                       double timestep) {
  const BodyMotions a(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_a[four.pair[k]->a]; });
  const BodyMotions b(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_b[four.pair[k]->b]; });
  const auto of_pairs = [&](double TouchingPair::*number) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return four.pair[k]->*number; });
  };
  return {.apart = apart,
          .velocity = {b.velocity.xyz - a.velocity.xyz - b.spin.xyz.cross(apart),
                       of_pairs(&TouchingPair::reduced_mass)},
          .spin = {b.spin.xyz - a.spin.xyz,
                   shared_limit(a.contacts_per_kg(), b.contacts_per_kg(), timestep)},
          .velocity_kick = {b.velocity_kick - a.velocity_kick - b.spin_kick.cross(apart),
                            of_pairs(&TouchingPair::damper_limit)},
          .spin_kick = b.spin_kick - a.spin_kick,
          .mean_spin = (a.spin.xyz + b.spin.xyz) * Lanes(.5)};
}

/// From a's centre to that of its sphere; w: the radius.
template <typename Other>
REPOSE_INLINE Columns to_sphere(const FourTouching<Other>& four) {
  return gather([&](std::size_t k) {
    return load_row(*four.sphere[k]) - load_row(four.motion[k]->position_a);
  });
}

REPOSE_INLINE void set_contacts(const Motions& motions, const Columns& to_a, Contacts& c) {
  c.spin = motions.spin.xyz;
  c.touch.shared_limit = motions.spin.w;
  c.arm_a = to_a.xyz + c.touch.normal * (to_a.w - c.touch.overlap * .5);
  c.arm_b = c.arm_a - motions.apart;
  c.apart = motions.apart;
  c.touch.reduced_mass = motions.velocity.w;
  c.touch.damper_limit = motions.velocity_kick.w;
  c.touch.half_velocity = motions.velocity.xyz + c.spin.cross(c.arm_a);
  c.touch.velocity =
      c.touch.half_velocity + motions.velocity_kick.xyz + motions.spin_kick.cross(c.arm_a);
  c.touch.twist = c.touch.normal.dot(motions.mean_spin);
}

template <bool is_round, typename Other>
REPOSE_INLINE void find_contacts(Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const FourTouching<Other>& four = of.touching;
  Contacts c;
  const Columns others = others_of(four);
  if constexpr (is_round) {
    const Lanes radius = each([&](std::size_t k) { return four.sphere[k]->radius; });
    set_geometry(four, others, radius, c);
    set_contacts(motions_of_round(four, sides, others.xyz, timestep), {{}, radius}, c);
  } else {
    const Columns to_a = to_sphere(four);
    set_geometry(four, others, to_a.w, c);
    set_contacts(motions_of(four), to_a, c);
  }
  of.contacts = c;
  const Columns memory = gather([&](std::size_t k) { return load_row(*four.memory[k]); });
  of.last_push = each([&](std::size_t k) { return four.memory[k]->push; });
  of.springs = {memory.xyz, memory.w, of.last_push};
}

}  // namespace repose::dem
