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
        fmt::format("its header claims {} x {} pixels, which is not a picture. Fix: save it again "
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

/// To be called where a file says how many bytes its pixels take, or can be asked.
/// @param claimed_bytes  what the size in the header comes to
/// @throws std::invalid_argument  "what. Fix: ..." when the file holds another number of them.
inline void check_claimed_bytes(std::int64_t width, std::int64_t height, std::int64_t claimed_bytes,
                                std::int64_t held_bytes) {
  if (claimed_bytes == held_bytes) return;
  throw std::invalid_argument(
      fmt::format("the picture is truncated or damaged: its header claims {} x {} pixels, which "
                  "take {} bytes, and it holds {}. Fix: copy it from its source again, or "
                  "save it as PNG.",
                  width, height, claimed_bytes, held_bytes));
}

}  // namespace repose::vision
