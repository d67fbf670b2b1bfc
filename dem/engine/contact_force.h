#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/contact/contact_table.h"
#include "dem/engine/bodies.h"
#include "dem/engine/lanes.h"
#include "dem/vector.h"

/// Forces of single contacts, and the lists of active contacts: rebuilt when spheres of a pair
/// touch or separate, and kept until that happens again.

namespace repose::dem {

/// What a contact remembers from step to step. All zero: no contact.
struct alignas(64) ContactHistory {
  Vector tangential = Vector::Zero();  ///< tangential spring's force on a, N
  double radius = 0;                   ///< of the contact area, m
  Vector rolling = Vector::Zero();     ///< rolling spring's torque on a, N m
  double push = 0;                     ///< normal force of the last step, N
};

/// ContactLaw, one per lane.
template <typename Number>
struct Law {
  Number reduced_young;
  Number reduced_shear;
  Number normal_damping;
  Number tangential_damping;
  Number sliding_friction;
  Number rolling_friction;
};

template <typename Number>
REPOSE_INLINE Law<Number> law_of(const ContactLaw& law) {
  return {Number(law.reduced_young_pa), Number(law.reduced_shear_pa),
          Number(law.normal_damping),   Number(law.tangential_damping),
          Number(law.sliding_friction), Number(law.rolling_friction)};
}

/// Two overlapping surfaces, seen from body a. Velocities are those of b's surface relative to a's.
template <typename Number>
struct ContactGeometry {
  Vec3<Number> normal;  ///< unit, from a to b
  Number overlap = {};  ///< m, > 0
  Number reduced_radius = {};
  Number reduced_mass = {};  ///< of the whole bodies, or this contact's share: see share_damping()
  Number damper_limit = {};  ///< see damper_limit(), N s/m
  Number max_stable_damping = {};  ///< see max_stable_damping(), N s/m
  Vec3<Number> half_velocity;      ///< half a step back: by which the springs stretch
  Vec3<Number> velocity;           ///< now, extrapolated with the last step's forces
  Number twist = {};               ///< mean spin of both about the normal, rad/s
};

/// The springs, carried from step to step, and the last step's normal force.
template <typename Number>
struct Springs {
  Vec3<Number> tangential;
  Number radius = {};
  Number push = {};
};

/// The force on a; b gets the opposite.
template <typename Number>
struct ContactForce {
  Number normal = {};  ///< magnitude, N, never negative
  Vec3<Number> total;  ///< N
};

/// Reduced mass, radius and the like: two in series.
template <typename Number>
REPOSE_INLINE Number reduced(const Number& x, const Number& y) {
  return x * y / (x + y);
}

/// The damper that would remove all of the relative velocity in one step, divided among the
/// `touching` contacts of two bodies.
template <typename Number>
REPOSE_INLINE Number damper_limit(const Number& reduced_mass, double timestep,
                                  const Number& touching) {
  return reduced_mass / (timestep * touching);
}

/// The same, divided among all contacts of either body, which are given as contacts per mass, 1/kg.
/// Explicit dampers must stay below it, or they overshoot (dem/THEORY.md; RoughDeadGrains.*).
template <typename Number>
REPOSE_INLINE Number max_stable_damping(const Number& contacts_a_per_kg,
                                        const Number& contacts_b_per_kg, double timestep) {
  return 1 / (timestep * (contacts_a_per_kg + contacts_b_per_kg));
}

/// Largest damper as a fraction of that limit. The normal damper is solved implicitly with its own
/// force (normal_force), which is stable beyond the limit; for two bodies alone it stays below this
/// at every accepted time step. The tangential damper is explicit, and spin counts: 1/m_eff =
/// 3.5/m* for spheres.
inline constexpr double kNormalDamperFraction = 2.0;
inline constexpr double kTangentialDamperFraction = .25;

/// What pushes two surfaces apart: the Hertz spring, N, and its parallel damper, N s/m.
template <typename Number>
struct NormalPush {
  Number spring = {};
  Number damper = {};
};

/// For the first and last step of an impact, in which the surfaces travel farther than they
/// overlap.
///
/// The powers of the overlap are averaged over the part of this step's path, and of the step before
/// or after, that lies within the contact: the result then hardly depends on where in a step an
/// impact begins. On the way out, only up to where the damper would pull: the spring A
/// overlap^(3/2) and the damper B overlap^(1/4) balance at overlap^(5/4) = B / A, and from `top` to
/// there the mean is .4 A (top^(5/4) - B / A)^2 / travel.
template <typename Number>
REPOSE_INLINE NormalPush<Number> averaged_hertz_force(const ContactGeometry<Number>& touch,
                                                      const Law<Number>& law,
                                                      const Number& approach,
                                                      const Number& travel) {
  const Number young_root = law.reduced_young * sqrt(touch.reduced_radius);
  const Number spring = 4.0 / 3 * young_root;
  const Number damper = law.normal_damping * sqrt(2 * young_root * touch.reduced_mass);
  const Number top = touch.overlap + travel * .5;
  const Number top_power = top * sqrt(sqrt(top));
  const Number end_power = max(-approach, Number{}) * damper / spring;
  const Number ends = min(end_power, top_power);
  return {.4 * spring * (top_power * top_power + ends * ends) / travel,
          .8 * damper * top_power / travel};
}

/// The normal force with the damper at the speed that results from the force itself; never
/// negative.
///
/// `approach` results from the last step's forces. Half a step of the change in force, times the
/// number of contacts that share the bodies, is still to be subtracted:
///   F = spring + damper (approach + (F_last - F) / (2 limit)),
/// solved for F. The error of the restitution is then a third to a fifth of that with `approach`
/// itself.
template <typename Number>
REPOSE_INLINE Number normal_force(const NormalPush<Number>& push,
                                  const ContactGeometry<Number>& touch, const Number& approach,
                                  const Number& last) {
  const Number half_damper =
      .5 * min(push.damper, kNormalDamperFraction * touch.max_stable_damping);
  const Number now = push.spring + 2 * half_damper * approach;
  return max((now * touch.damper_limit + half_damper * last) / (touch.damper_limit + half_damper),
             Number{});
}

/// Hertz-Mindlin without slip, Coulomb's limit, damping.
///
/// Normal: Hertz, F = 4/3 E* a delta, a = sqrt(R* delta) (Johnson 1985, eqs. 4.22-4.24), with the
/// damper of restitution.h. Tangential: Mindlin's stiffness S_t = 8 G* a, incremental; the spring
/// rotates with the contact and shrinks with a when unloading, so that no energy is created
/// (Thornton, Cummins, Cleary 2013, Powder Technology 233, eqs. 15-17). Small strains: delta << R*.
/// Proved by tests/dem/impact_test.cpp.
template <typename Number>
REPOSE_INLINE ContactForce<Number> contact_force(const ContactGeometry<Number>& touch,
                                                 const Law<Number>& law, double timestep,
                                                 Springs<Number>& springs) {
  const Vec3<Number>& n = touch.normal;
  const Number a = sqrt(touch.reduced_radius * touch.overlap);
  const Number normal_stiffness = 2 * law.reduced_young * a;
  const Number tangential_stiffness = 8 * law.reduced_shear * a;
  const Number mass_root = sqrt(normal_stiffness * touch.reduced_mass);
  const Number tangential_damper =
      min(law.tangential_damping * mass_root, kTangentialDamperFraction * touch.max_stable_damping);

  const Number approach = -touch.velocity.dot(n);
  const Number travel = abs(approach) * timestep;
  NormalPush<Number> push = {2.0 / 3 * normal_stiffness * touch.overlap,
                             law.normal_damping * mass_root};
  // Slightly more: the path may be exactly one step long, up to rounding.
  const auto is_brief = touch.overlap <= 1.000001 * travel;
  if (any(is_brief)) {
    const NormalPush<Number> brief = averaged_hertz_force(touch, law, approach, travel);
    push = {select(is_brief, brief.spring, push.spring),
            select(is_brief, brief.damper, push.damper)};
  }
  ContactForce<Number> force;
  force.normal = normal_force(push, touch, approach, springs.push);

  Vec3<Number> spring = springs.tangential;
  const Number old_size2 = spring.squared_norm();
  spring -= n * n.dot(spring);
  // Keeps its magnitude while rotating, by sqrt(1 + x) = 1 + x/2 - x^2/8, to 1e-16 for the small
  // rotation of one step.
  const Number lost = old_size2 / spring.squared_norm();
  const Number more = lost - 1;
  Number scale = 1 + more * (.5 - .125 * more);
  if (any(lost >= Number(1.00001))) scale = select(lost >= Number(1.00001), sqrt(lost), scale);
  scale = scale * min(a / springs.radius, Number(1));
  const Vec3<Number> carried = (spring + n.cross(spring) * (timestep * touch.twist)) * scale;
  const Vec3<Number> half_slip = touch.half_velocity - n * n.dot(touch.half_velocity);
  const Vec3<Number> stretch = half_slip * (tangential_stiffness * timestep);
  // A zero spring has no direction to keep.
  spring = select(spring.squared_norm() > Number(0), carried + stretch, stretch);

  // Either the spring slides, without a damper, or both together are at most the limit. Branchless:
  // which contacts slide is unpredictable.
  const Number limit = law.sliding_friction * force.normal;
  const Number limit2 = limit * limit;
  const Vec3<Number> damped = spring + (touch.velocity + n * approach) * tangential_damper;
  const Number size2 = spring.squared_norm();
  const Number damped2 = damped.squared_norm();
  const auto slides = size2 > limit2;
  const auto is_over = damped2 > 1.000000000001 * limit2;  // beyond rounding
  const Number fraction = limit / sqrt(select(slides, size2, damped2));
  const Vec3<Number> tangential =
      select(slides, spring, damped) * select(slides | is_over, fraction, Number(1));
  spring = spring * select(slides, fraction, Number(1));
  springs.tangential = spring;
  springs.radius = a;
  springs.push = force.normal;
  force.total = tangential - n * force.normal;
  return force;
}

/// Pairs of grains processed together: few enough for their loads to stay in the L1 cache.
inline constexpr std::size_t kPairsTogether = 64;

/// What all contacts of a pair of grains, or of a grain and a wall, share for as long as the same
/// spheres touch. Kept small: with many grains these do not stay in the caches from step to step.
struct ActivePair {
  int a = 0;  ///< a body
  int b = 0;  ///< a body, or a wall
  const ContactLaw* law = nullptr;
  int number = 0;           ///< within the pairs processed together
  int touching = 0;         ///< number of contacts
  double reduced_mass = 0;  ///< of both bodies, kg
  double damper_limit = 0;  ///< see damper_limit(), N s/m
};

/// A sphere of body a that touches something, as indices.
struct ActiveContact {
  int sphere = 0;
  int other = 0;   ///< a sphere of body b, or a facet of a wall
  int memory = 0;  ///< its ContactHistory
  int pair = 0;    ///< its ActivePair
};

/// The contacts of up to kPairsTogether pairs of grains.
struct TouchingChunk {
  bool is_known = false;  ///< false: the rest must be rebuilt
  std::vector<ActivePair> pairs;
  std::vector<ActiveContact> contacts;
};

}  // namespace repose::dem
