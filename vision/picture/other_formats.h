#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a BMP file's content.
/// @throws base::InputError  "what. Fix: ..." if it is damaged, truncated, run-length coded or too
///   large.
Picture decode_bmp(std::span<const std::uint8_t> bytes);

/// Decodes a WebP file's content, upright.
/// @throws base::InputError  "what. Fix: ..." if it is damaged, truncated, animated or too large.
Picture decode_webp(std::span<const std::uint8_t> bytes);

/// Decodes the main picture of a HEIC, HEIF or AVIF file's content, upright. More than eight bits
/// per channel become eight.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, too large or of a
///   kind that is not read.
Picture decode_heif(std::span<const std::uint8_t> bytes);

/// Decodes the largest page of a TIFF file's content, upright.
///
/// OpenCV could do it too, but prints to stderr if the file is damaged and does not support CMYK.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, too large or of a
///   kind that is not read.
Picture decode_tiff(std::span<const std::uint8_t> bytes);

}  // namespace repose::vision
