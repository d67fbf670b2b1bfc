#include "dem/experiment/bench_setup.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "dem/engine/time_step.h"

namespace repose::dem {
namespace {

Material softened(Material material, double factor) {
  material.young_modulus_pa *= factor;
  return material;
}

ContactTable contact_table(const Bench& bench) {
  // What walls do to each other is never asked for.
  return {{softened(bench.grain_material, bench.stiffness_factor),
           softened(bench.wall_material, bench.stiffness_factor)},
          {bench.grain_grain, bench.grain_wall, bench.grain_wall, bench.grain_wall},
          bench.rolling};
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

void find_faults(const Bench& bench, Faults& faults) {
  bool has_radii = !bench.grain.spheres.empty();
  for (const ClumpSphere& sphere : bench.grain.spheres) {
    has_radii = has_radii && is_positive(sphere.radius) && sphere.centre.allFinite();
  }
  faults.require(has_radii && is_positive(bench.grain.volume_m3) &&
                     bench.grain.gyration_m2.allFinite() && bench.grain.gyration_m2.minCoeff() > 0,
                 "grain: it has no spheres, volume or inertia. Fix: make it from a scan or from "
                 "its sizes.");
  const bool has_stiffness = is_positive(bench.stiffness_factor);
  faults.require(has_stiffness,
                 fmt::format("stiffness_factor is {:g}. Rule: above 0. Fix: 1 for the real "
                             "material.",
                             bench.stiffness_factor));
  faults.require(bench.timestep_fraction > 0 && bench.timestep_fraction <= 1,
                 fmt::format("timestep_fraction is {:g}. Rule: above 0, at most 1. Fix: 1.",
                             bench.timestep_fraction));
  faults.require(!bench.timestep_s || is_positive(*bench.timestep_s),
                 fmt::format("timestep_s is {:g}. Rule: above 0. Fix: leave it to the program.",
                             bench.timestep_s.value_or(0)));
  faults.require(bench.threads >= 1,
                 fmt::format("threads is {}. Rule: 1 or more. Fix: 1.", bench.threads));
  if (!has_stiffness) return;
  try {
    contact_table(bench);
  } catch (const std::invalid_argument& error) {
    faults.add(error.what());
  }
}

Wall bench_wall(WallShape shape, const Pose& pose) {
  return {std::move(shape), kWallMaterial, pose, {}};
}

SimulationSetup bench_setup(const Bench& bench, const ClumpShape& shape, std::vector<Wall> walls,
                            double speed_m_s, double timestep_share) {
  SimulationSetup setup{.kinds = {{.shape = shape, .material = kGrainMaterial}},
                        .walls = std::move(walls),
                        .contacts = contact_table(bench),
                        .threads = bench.threads};
  if (bench.timestep_s) {
    check_timestep(*bench.timestep_s, setup, speed_m_s);
    setup.timestep_s = *bench.timestep_s;
  } else {
    setup.timestep_s =
        bench.timestep_fraction * timestep_share * accurate_timestep_s(setup, speed_m_s);
  }
  return setup;
}

}  // namespace repose::dem
