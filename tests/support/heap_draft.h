#pragma once

#include <cstdint>
#include <numbers>
#include <string_view>

#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"

namespace repose::testing {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A scene under construction, and the random numbers it is made from.
struct Draft {
  HeapScene scene;
  Random random;
};

Side any_side(Random& random);

void choose_angles(HeapForm& form, double mean_rad, double spread_rad, Random& random);

/// The crest leans on a wall or on the frame, so only one side of the uncut cone is in the picture.
/// Both sides of the form become alike.
void lean_on_wall(HeapForm& form, Random& random);

/// A good laboratory picture: the start of every condition.
Draft draft(std::string_view condition, std::uint64_t seed);

}  // namespace repose::testing
