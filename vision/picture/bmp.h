#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a BMP file's content.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, run-length coded
///   or too large.
Picture decode_bmp(std::span<const std::uint8_t> bytes);

}  // namespace repose::vision
