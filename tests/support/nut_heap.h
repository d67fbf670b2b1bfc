#pragma once

#include <cmath>
#include <cstdint>

#include "dem/shape/scan/calliper.h"
#include "render/scene/scene.h"
#include "tests/support/heap_random.h"

/// Scenes to draw without a simulation.
namespace repose::testing {

inline constexpr double kNutLength_m = 22.48e-3;
inline constexpr double kNutWidth_m = 18.23e-3;

/// A hazelnut: its surface, and two spheres that represent it.
inline dem::ClumpShape nut() {
  dem::ClumpShape shape;
  shape.surface = dem::calliper_surface({.length_m = kNutLength_m,
                                         .width_m = kNutWidth_m,
                                         .thickness_m = 17.46e-3,
                                         .tip_fraction = .5});
  shape.spheres = {{.centre = {-2.6e-3, 0, 0}, .radius = 8.2e-3},
                   {.centre = {2.2e-3, 0, 0}, .radius = 7.2e-3}};
  shape.volume_m3 = 3.7e-6;
  shape.gyration_m2 = {2e-5, 2.5e-5, 2.5e-5};
  return shape;
}

/// A square plate whose upper face is z = 0.
inline render::PlacedWall plate(double side_m) {
  constexpr double kHalfThickness_m = 1e-3;
  return {.shape = dem::Box{.half_size = {side_m / 2, side_m / 2, kHalfThickness_m}},
          .pose = {.position = {0, 0, -kHalfThickness_m}}};
}

/// Uniform over all rotations (Shoemake 1992).
inline dem::Quaternion any_orientation(Random& random) {
  const double u = random.uniform(0, 1), a = random.uniform(0, 2 * std::numbers::pi),
               b = random.uniform(0, 2 * std::numbers::pi);
  return {std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
          std::sqrt(u) * std::sin(b), std::sqrt(u) * std::cos(b)};
}

/// Nuts in layers, within a cone of that angle, on a plate: `across` of them along the base's
/// diameter. They do not touch as real ones do, but look like a heap.
inline render::Scene nut_heap(int across, double angle_rad, std::uint64_t seed) {
  render::Scene scene{.shapes = {nut()}, .grains = {}, .walls = {}};
  const double step = .95 * kNutWidth_m, radius = .5 * across * step;
  Random random(seed);
  for (int layer = 0;; ++layer) {
    const double z = .5 * kNutWidth_m + .8 * step * layer;
    const double reach = radius - (z - .5 * kNutWidth_m) / std::tan(angle_rad);
    if (reach < 0) break;
    const double shift = (layer % 2) * .5 * step;
    for (int i = -across; i <= across; ++i) {
      for (int j = -across; j <= across; ++j) {
        // One by one: the evaluation order of a call's arguments depends on the compiler.
        const double y = j * step + shift + .1 * step * random.uniform(-1, 1);
        const double x = i * step + shift + .1 * step * random.uniform(-1, 1);
        const dem::Vector place(x, y, z);
        if (std::hypot(place.x(), place.y()) > reach) continue;
        const auto number = static_cast<int>(scene.grains.size());
        scene.grains.push_back(
            {.number = number,
             .pose = {.position = place, .orientation = any_orientation(random)}});
      }
    }
  }
  scene.walls.push_back(plate(3.2 * radius));
  return scene;
}

/// Spheres of equal size at these places.
inline render::Scene sphere_scene(double radius_m, const std::vector<dem::Vector>& places) {
  render::Scene scene{.shapes = {dem::sphere_shape(radius_m)}, .grains = {}, .walls = {}};
  for (const dem::Vector& place : places) {
    scene.grains.push_back({.number = static_cast<int>(scene.grains.size()), .pose = {place}});
  }
  return scene;
}

}  // namespace repose::testing
