#pragma once

#include <span>
#include <type_traits>

#include "dem/contact/contact_table.h"
#include "dem/engine/contact_lanes.h"
#include "dem/engine/rolling.h"
#include "dem/wall/wall_set.h"

/// The third pass of four contacts: what they do to the bodies, and what they remember.
namespace repose::dem {

/// Of both bodies about the contact; a wall has no inertia.
template <typename Other>
REPOSE_INLINE Lanes contact_inertia(const Four<Other>& of, const Sides<Other>& sides) {
  const auto about_contact =
      [](const auto& motion, const Vec3<Lanes>& arm) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return motion(k).spin_kick.w; }) +
           each([&](std::size_t k) { return motion(k).spin.w; }) * arm.squared_norm();
  };
  const auto& pair = of.touching.pair;
  const Lanes a =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_a[pair[k]->a]; },
                    of.contacts.arm_a);
  if constexpr (std::is_same_v<Other, FacetContact>) return a;
  const Lanes b =
      about_contact([&](std::size_t k) -> const BodyMotion& { return sides.motions_b[pair[k]->b]; },
                    of.contacts.arm_b);
  return reduced(a, b);
}

/// The moment of inertia that a contact's torques may act on as if alone: of each body the smallest
/// one, shared by all that it touches; a wall has no end of it.
template <typename Other>
REPOSE_INLINE Lanes inertia_share(const Four<Other>& of, const Sides<Other>& sides) {
  const auto& pair = of.touching.pair;
  const auto contacts_per_inertia = [&](const auto& motion) __attribute__((always_inline)) {
    return each([&](std::size_t k) { return contacts_of(*pair[k], motion(k)); }) /
           each([&](std::size_t k) { return motion(k).spin_kick.w; });
  };
  const Lanes a = contacts_per_inertia(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_a[pair[k]->a]; });
  if constexpr (std::is_same_v<Other, FacetContact>) return 1 / a;
  const Lanes b = contacts_per_inertia(
      [&](std::size_t k) -> const BodyMotion& { return sides.motions_b[pair[k]->b]; });
  return 1 / (a + b);
}

/// The torque on a of the models that work on the relative spin.
template <RollingModel model, typename Other>
REPOSE_INLINE Vec3<Lanes> rolling_torque(const Four<Other>& of, const Sides<Other>& sides,
                                         const Law<Lanes>& law, double timestep) {
  const Contacts& c = of.contacts;
  Roll<Lanes> roll = {.normal = c.touch.normal,
                      .spin = -c.spin,
                      .normal_force = of.force.normal,
                      .last_force = of.last_push,
                      .overlap = c.touch.overlap,
                      .reduced_radius = c.touch.reduced_radius,
                      .inertia_share = {},
                      .contact_inertia = {}};
  const auto& memory = of.touching.memory;
  // The row's w is the push: read, and left alone.
  Vec3<Lanes> spring = gather([&](std::size_t k) { return load(memory[k]->rolling.data()); }).xyz;
  Vec3<Lanes> torque;
  if constexpr (model == RollingModel::relative_constant_torque) {
    roll.inertia_share = inertia_share(of, sides);
    torque = relative_constant_torque(roll, law, timestep, spring);
  } else {
    roll.contact_inertia = contact_inertia(of, sides);
    torque = elastic_plastic_torque(roll, law, timestep, spring);
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    memory[k]->rolling = {spring.x[k], spring.y[k], spring.z[k]};
  }
  return torque;
}

/// What four contacts do to the bodies: in lanes.
struct Loads {
  Vec3<Lanes> torque_a;
  Lanes rolling_a;  ///< what constant-torque rolling friction may take
  Lanes rolling_b;
};

template <RollingModel model, typename Other>
REPOSE_INLINE Loads loads_of(const Four<Other>& of, const Sides<Other>& sides, double timestep) {
  const Contacts& c = of.contacts;
  Loads loads = {.torque_a = c.arm_a.cross(of.force.total), .rolling_a = {}, .rolling_b = {}};
  if constexpr (model == RollingModel::constant_torque) {
    const Lanes resistance = laws_of(of.touching).rolling_friction * of.force.normal;
    loads.rolling_a = resistance * sqrt(c.arm_a.squared_norm());
    loads.rolling_b = resistance * sqrt(c.arm_b.squared_norm());
  } else if constexpr (model != RollingModel::none) {
    loads.torque_a += rolling_torque<model>(of, sides, laws_of(of.touching), timestep);
  }
  return loads;
}

/// Adds to the loads of their pairs. Those of round grains, which have one contact, are whole then.
template <bool is_round, typename Other>
REPOSE_INLINE void add_loads(const Four<Other>& of, const Loads& loads) {
  const Rows torques_a = rows_of(loads.torque_a, loads.rolling_a);
  if constexpr (is_round) {
    const Vec3<Lanes> torque_b = of.contacts.apart.cross(of.force.total) - loads.torque_a;
    const Rows torques_b = rows_of(torque_b, loads.rolling_b);
    const Rows forces = rows_of(of.force.total, Lanes(1));
    for (std::size_t k = 0; k < kLanes; ++k) {
      *of.touching.load[k] = {forces.row[k], torques_a.row[k], torques_b.row[k]};
    }
    return;
  }
  const Rows forces = rows_of(of.force.total, loads.rolling_b);
  for (std::size_t k = 0; k < kLanes; ++k) {
    PairLoad& load = *of.touching.load[k];
    load.force += forces.row[k];
    load.torque_a += torques_a.row[k];
  }
}

/// @return how deep they are, as fractions of the smaller sphere's radius
template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes finish_contacts(const Four<Other>& of, const Sides<Other>& sides,
                                    double timestep) {
  add_loads<is_round>(of, loads_of<model>(of, sides, timestep));
  const Rows memories = rows_of(of.springs.tangential, of.springs.radius);
  for (std::size_t k = 0; k < kLanes; ++k) {
    ContactMemory& own = *of.touching.memory[k];
    store_row(memories.row[k], own);
    own.push = of.springs.push[k];
  }
  return of.contacts.touch.overlap / of.contacts.smaller_radius;
}

template <bool is_round, RollingModel model, typename Other>
REPOSE_INLINE Lanes finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
                               double timestep) {
  Lanes deepest;
  for (const Four<Other>& four : fours) {
    deepest = greatest(finish_contacts<is_round, model>(four, sides, timestep), deepest);
  }
  return deepest;
}

template <bool is_round, typename Other>
REPOSE_INLINE Lanes finish_all(std::span<const Four<Other>> fours, const Sides<Other>& sides,
                               RollingModel model, double timestep) {
  switch (model) {
    case RollingModel::none:
      return finish_all<is_round, RollingModel::none>(fours, sides, timestep);
    case RollingModel::constant_torque:
      return finish_all<is_round, RollingModel::constant_torque>(fours, sides, timestep);
    case RollingModel::relative_constant_torque:
      return finish_all<is_round, RollingModel::relative_constant_torque>(fours, sides, timestep);
    case RollingModel::elastic_plastic:
      return finish_all<is_round, RollingModel::elastic_plastic>(fours, sides, timestep);
  }
  return {};
}

}  // namespace repose::dem
