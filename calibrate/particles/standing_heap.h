#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "calibrate/particles/particles.h"
#include "render/scene/scene.h"

/// A heap on its plate, out of the places of particles.
namespace repose::calibrate {

enum class Up { x, y, z, minus_x, minus_y, minus_z };

inline constexpr std::array<std::pair<std::string_view, Up>, 6> kUpNames = {{{"x", Up::x},
                                                                             {"y", Up::y},
                                                                             {"z", Up::z},
                                                                             {"-x", Up::minus_x},
                                                                             {"-y", Up::minus_y},
                                                                             {"-z", Up::minus_z}}};

constexpr std::string_view name_of(Up up) {
  for (const auto& [name, one] : kUpNames) {
    if (one == up) return name;
  }
  return {};
}

struct HeapPlacement {
  Up up = Up::z;
  /// Where the plate's upper face meets the axis that points up or down, in the file's numbers and
  /// unit; none: found under the heap.
  std::optional<double> plate = {};
};

struct StandingHeap {
  /// z upwards, the plate at 0, turned and moved from the file's axes. Metres; where the unit is
  /// not known, such that half of the spheres have a radius of at most 1 mm.
  render::Scene scene;
  bool has_unit = false;
  double plate = 0;  ///< as HeapPlacement has it
  bool is_plate_given = false;
  std::size_t spheres = 0;      ///< that are drawn
  std::size_t grains = 0;       ///< that these make up
  std::size_t below_plate = 0;  ///< grains that have fallen off it and are left out
  /// Of spheres of different grains that touch, how many overlap by more than two fifths of the
  /// smaller one's radius.
  double deep_percent = 0;
  std::size_t in_the_air = 0;  ///< grains that touch neither the heap nor the plate: left out
};

/// Spheres touch where less than a tenth of the smaller one's radius is between them. The heap is
/// what hangs together by contacts and has most grains. The plate is where its lowest grains stand:
/// of n grains at least three, and .5 n^(2/3), have their lowest points within a fifth of the
/// median radius there. (A cone of 25 degrees stands on about 5 n^(2/3).) Proved by StandingHeap.*
/// in tests/calibrate/particles_test.cpp.
/// @throws base::InputError  no plate can be told, two heaps, a heap of which much is in the air.
StandingHeap standing_heap(const std::string& file, const Particles& particles,
                           const HeapPlacement& placement);

}  // namespace repose::calibrate
