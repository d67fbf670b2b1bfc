#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "calibrate/particles/particles.h"
#include "render/scene/scene.h"

/// A heap on its plate, reconstructed from particle positions.
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
  /// Coordinate of the plate's upper face along the vertical axis, in the file's axes and unit;
  /// std::nullopt: found under the heap.
  std::optional<double> plate = {};
};

struct StandingHeap {
  /// z upwards, the plate at 0, turned and moved from the file's axes. Metres; if the unit is not
  /// known, scaled so that half of the spheres have a radius of at most 1 mm.
  render::Scene scene;
  bool has_unit = false;
  double plate = 0;  ///< see HeapPlacement
  bool is_plate_given = false;
  std::size_t spheres = 0;      ///< drawn
  std::size_t grains = 0;       ///< made up of these
  std::size_t below_plate = 0;  ///< grains that fell off it; left out
  /// Percentage of touching spheres of different grains that overlap by more than two fifths of the
  /// smaller radius.
  double deep_percent = 0;
  std::size_t in_the_air = 0;  ///< grains that touch neither the heap nor the plate; left out
};

/// Spheres count as touching if the gap is less than a tenth of the smaller radius. The heap is the
/// largest cluster connected by contacts. The plate is where its lowest grains stand: of n grains,
/// at least three and at least .5 n^(2/3) have their lowest points within a fifth of the median
/// radius of it. (A cone of 25 degrees stands on about 5 n^(2/3).) Proved by StandingHeap.* in
/// tests/calibrate/particles_test.cpp.
/// @throws base::InputError  no plate can be identified, there are two heaps, or much of the heap
/// is
///   in the air.
StandingHeap standing_heap(const std::string& file, const Particles& particles,
                           const HeapPlacement& placement);

}  // namespace repose::calibrate
