#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a WebP file's content, upright.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, moving or too
///   large.
Picture decode_webp(std::span<const std::uint8_t> bytes);

}  // namespace repose::vision
