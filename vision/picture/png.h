#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a PNG file's content, upright.
///
/// OpenCV could do it too, but lets libpng print to stderr, even for harmless colour profiles.
/// @throws base::InputError  "what. Fix: ..." if it is damaged, truncated or too large.
Picture decode_png(std::span<const std::uint8_t> bytes);

/// The content of a PNG file.
/// @throws base::InputError  "what. Fix: ..." if it has more pixels than a PNG can have.
std::vector<std::uint8_t> encode_png(const Picture& picture);

}  // namespace repose::vision
