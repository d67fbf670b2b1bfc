#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "vision/picture/picture.h"

namespace repose::vision {

/// To be called with the size in a file's header, before memory for the pixels is asked for.
/// @throws std::invalid_argument  "what. Fix: ..." when no picture can have that size.
inline void check_claimed_size(std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument(
        fmt::format("its header claims {} x {} pixels, which is no picture. Fix: save it again "
                    "from the program it came from.",
                    width, height));
  }
  if (width > std::numeric_limits<int>::max() || height > kMaxPixels / width) {
    throw std::invalid_argument(
        fmt::format("its header claims {} x {} pixels, more than the {} million allowed. Fix: "
                    "reduce or crop it first; 12 million pixels are plenty.",
                    width, height, kMaxPixels / 1'000'000));
  }
}

}  // namespace repose::vision
