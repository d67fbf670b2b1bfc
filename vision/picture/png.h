#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a PNG file's content, upright.
///
/// OpenCV would do it too, but lets libpng print to stderr, also for harmless colour profiles.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short or too large.
Picture decode_png(std::span<const std::uint8_t> bytes);

/// The content of a PNG file.
/// @throws base::InputError  "what. Fix: ..." when it has more pixels than a PNG can.
std::vector<std::uint8_t> encode_png(const Picture& picture);

}  // namespace repose::vision
