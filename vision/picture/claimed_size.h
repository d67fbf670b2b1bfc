#pragma once

#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "base/input_error.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// To be called with the size in a file's header, before memory for the pixels is asked for.
/// @throws base::InputError  "what. Fix: ..." when no picture can have that size.
inline void check_claimed_size(std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0) {
    throw base::InputError(
        {.value =
             fmt::format("its header claims {} x {} pixels, which is not a picture", width, height),
         .fix = "save it again from the program it came from."});
  }
  if (width > std::numeric_limits<int>::max() || height > kMaxPixels / width) {
    throw base::InputError(
        {.value = fmt::format("its header claims {} x {} pixels, more than the {} million allowed",
                              width, height, kMaxPixels / 1'000'000),
         .fix = "reduce or crop it first; 12 million pixels are plenty."});
  }
}

/// To be called where a file says how many bytes its pixels take, or can be asked.
/// @param claimed_bytes  what the size in the header comes to
/// @throws base::InputError  "what. Fix: ..." when the file holds another number of them.
inline void check_claimed_bytes(std::int64_t width, std::int64_t height, std::int64_t claimed_bytes,
                                std::int64_t held_bytes) {
  if (claimed_bytes == held_bytes) return;
  throw base::InputError(
      {.value = fmt::format("the picture is truncated or damaged: its header claims {} x {} "
                            "pixels, which take {} bytes, and it holds {}",
                            width, height, claimed_bytes, held_bytes),
       .fix = "copy it from its source again, or save it as PNG."});
}

}  // namespace repose::vision
