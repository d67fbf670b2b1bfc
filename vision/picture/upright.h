#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

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
