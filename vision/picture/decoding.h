#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <opencv2/core/mat.hpp>

#include "base/input_error.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// Call with the size in a file's header, before allocating memory for the pixels.
/// @throws base::InputError  "what. Fix: ..." if no picture can have that size.
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

/// Call if the number of bytes that the file holds for its pixels is known.
/// @param claimed_bytes  as implied by the size in the header
/// @throws base::InputError  "what. Fix: ..." if the file holds a different number of bytes.
inline void check_claimed_bytes(std::int64_t width, std::int64_t height, std::int64_t claimed_bytes,
                                std::int64_t held_bytes) {
  if (claimed_bytes == held_bytes) return;
  throw base::InputError(
      {.value = fmt::format("the picture is truncated or damaged: its header claims {} x {} "
                            "pixels, which take {} bytes, and it holds {}",
                            width, height, claimed_bytes, held_bytes),
       .fix = "copy it from its source again, or save it as PNG."});
}

/// Makes an 8-bit colour picture from decoded samples: 8 or 16 bits deep; grey, BGR, or BGRA with
/// colours not premultiplied by alpha.
///
/// - 16 bits: the full range becomes 0 to 255. Cameras store 10 to 14 bits in 16 without stretching
///   them, which would look almost black; so if nothing in the picture reaches a quarter of the
///   range, its maximum becomes 255.
/// - Transparency: composited over white or black, whichever is farther from the mean brightness of
///   what is visible, so that the heap stands out from its background.
/// @throws base::InputError  "what. Fix: ..." if it is fully transparent.
Picture flatten(const cv::Mat& decoded);

/// Camera orientation, as numbered by the EXIF standard (tag 0x0112): 1 upright, 2 mirrored, 3
/// upside down, 4 upside down and mirrored, 5 to 8 on its side.
inline constexpr int kUprightOrientation = 1;

/// Orientation from a JPEG's content. Upright if there is none or it is invalid.
int jpeg_orientation(std::span<const std::uint8_t> jpeg);

/// The same from the EXIF block of a PNG or WebP, which lacks the "Exif" in front.
int exif_block_orientation(std::span<const std::uint8_t> block);

/// The upright picture from one stored with `orientation`.
Picture turned_upright(Picture picture, int orientation);

}  // namespace repose::vision
