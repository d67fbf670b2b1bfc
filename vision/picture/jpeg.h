#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a JPEG file's content, not yet turned upright.
///
/// OpenCV would do it too, but it returns half a picture without a word when the file is cut short.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short or too large.
Picture decode_jpeg(std::span<const std::uint8_t> bytes);

/// The content of a JPEG file: its colours at half the resolution.
/// @param quality  1 to 100
/// @throws base::InputError  "what. Fix: ..." when it has more pixels than a JPEG can.
std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality);

}  // namespace repose::vision
