#pragma once

#include <cmath>
#include <utility>

#include "dem/verify/scene.h"

namespace repose::dem {

/// Blocks of two sizes in a tube standing on a plate, each in its own pose.
inline SimulationSetup packing_setup(RollingModel rolling = RollingModel::elastic_plastic,
                                     DampingModel damping = DampingModel::per_contact) {
  const Material soft{
      .name = "soft", .density_kg_m3 = 1000, .young_modulus_pa = 5e6, .poisson_ratio = .3};
  SimulationSetup setup = scene_of(
      block_shape({.010, .007, .005}, .004), soft, soft,
      {.restitution = .3, .sliding_friction = .5, .rolling_friction = .05}, rolling, damping);
  setup.kinds.push_back({.shape = block_shape({.006, .005, .004}, .003), .material = 0});
  const Wall plate{
      .shape = Box{.half_size = {.1, .1, .01}}, .material = 1, .pose = {.position = {0, 0, -.01}}};
  const Wall tube{.shape = Tube{.inner_radius = .03, .thickness = .003, .height = .2},
                  .material = 1};
  setup.walls = {plate, tube};
  setup.gravity = {0, 0, -kStandardGravity_m_s2};
  setup.timestep_s = 2e-5;
  return setup;
}

/// Grain number k of a loose column, not touching the others.
inline Grain loose_grain(int k) {
  const Vector turn(std::sin(1.0 + k), std::sin(2.1 * k), std::cos(3.3 * k));
  const double angle = 2.4 * k;
  Grain grain;
  grain.kind = k % 2;
  grain.position = {.013 * std::cos(angle), .013 * std::sin(angle), .014 + .008 * k};
  grain.orientation = Eigen::AngleAxisd(k, turn.normalized());
  grain.velocity = .1 * turn;
  grain.spin = 5 * turn;
  return grain;
}

inline Simulation loose_packing(SimulationSetup setup, int grains) {
  Simulation simulation(std::move(setup));
  for (int k = 0; k < grains; ++k) simulation.add(loose_grain(k));
  return simulation;
}

}  // namespace repose::dem
