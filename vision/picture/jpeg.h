#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a JPEG file's content, not yet turned upright.
///
/// OpenCV could do it too, but silently returns half a picture if the file is truncated.
/// @throws base::InputError  "what. Fix: ..." if it is damaged, truncated or too large.
Picture decode_jpeg(std::span<const std::uint8_t> bytes);

/// The content of a JPEG file, with chroma at half the resolution.
/// @param quality  1 to 100
/// @throws base::InputError  "what. Fix: ..." if it has more pixels than a JPEG can have.
std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality);

}  // namespace repose::vision
