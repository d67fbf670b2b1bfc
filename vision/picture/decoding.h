#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <opencv2/core/mat.hpp>

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

/// Makes an 8-bit colour picture of decoded samples: 8 or 16 bits deep; grey, BGR or BGRA with the
/// colours not yet multiplied by alpha.
///
/// - 16 bits: the full range becomes 0 to 255. Cameras store 10 to 14 bits in 16 without
///   stretching them, which would come out almost black; so when nothing in the picture reaches a
///   quarter of the range, its maximum becomes 255.
/// - Transparency: laid over white or black, whichever is farther from the mean brightness of what
///   can be seen, so that the heap stands out from its background.
/// @throws base::InputError  "what. Fix: ..." when it is fully transparent.
Picture flatten(const cv::Mat& decoded);

/// How a camera was held, by the numbers of the EXIF standard (tag 0x0112): 1 upright, 2 mirrored,
/// 3 upside down, 4 upside down and mirrored, 5 to 8 lying on a side.
inline constexpr int kUprightOrientation = 1;

/// Orientation from a JPEG's content. Upright when there is none or it is no orientation.
int jpeg_orientation(std::span<const std::uint8_t> jpeg);

/// The same from the EXIF block of a PNG or WebP, which lacks the "Exif" in front.
int exif_block_orientation(std::span<const std::uint8_t> block);

/// The picture as it was seen, from one stored with `orientation`.
Picture turned_upright(Picture picture, int orientation);

}  // namespace repose::vision
