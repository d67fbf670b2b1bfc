#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "tests/support/heap_conditions.h"
#include "vision/picture/picture.h"

/// Test pictures of heaps whose angles are known.
namespace repose::bench {

/// Angles from the ground; std::nullopt if there is no such flank.
struct FlankAngles {
  std::optional<double> left_rad = {};
  std::optional<double> right_rad = {};

  /// Mean of the flanks that exist.
  std::optional<double> mean_rad() const {
    if (left_rad && right_rad) return (*left_rad + *right_rad) / 2;
    return left_rad ? left_rad : right_rad;
  }
};

struct KnownPicture {
  vision::Picture picture;
  FlankAngles heap;       ///< what a measurement should find
  FlankAngles seen = {};  ///< of the exact outline in this picture, if that differs
  std::optional<double> told_pitch_rad = {};  ///< the camera's, if given to the measurement
};

/// A picture that can be reproduced.
struct Subject {
  std::string_view
      section;  ///< how its pictures are made: "drawn", "rendered", or "other" without a heap
  std::string_view condition;  ///< what makes it easy or hard
  testing::Group group = testing::Group::clean;
  std::uint64_t seed = 1;
  std::function<KnownPicture()> take;
};

}  // namespace repose::bench
