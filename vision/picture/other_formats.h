#pragma once

#include <cstdint>
#include <span>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Decodes a BMP file's content.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, run-length coded
///   or too large.
Picture decode_bmp(std::span<const std::uint8_t> bytes);

/// Decodes a WebP file's content, upright.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, moving or too
///   large.
Picture decode_webp(std::span<const std::uint8_t> bytes);

/// Decodes the main picture of a HEIC, HEIF or AVIF file's content, upright. More than eight bits
/// a colour become eight.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, too large or of a
///   kind that is not read.
Picture decode_heif(std::span<const std::uint8_t> bytes);

/// Decodes the first page of a TIFF file's content, upright.
///
/// OpenCV would do it too, but it prints to stderr when the file is damaged and knows no CMYK.
/// @throws base::InputError  "what. Fix: ..." when it is damaged, cut short, too large or of a
///   kind that is not read.
Picture decode_tiff(std::span<const std::uint8_t> bytes);

}  // namespace repose::vision
