#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes the first page of a TIFF file's content, upright.
///
/// OpenCV would do it too, but it prints to stderr when the file is damaged and knows no CMYK.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, too large or of a
///   kind that is not read.
Picture decode_tiff(std::span<const std::uint8_t> bytes);

}  // namespace repose::vision
