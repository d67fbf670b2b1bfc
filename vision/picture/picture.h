#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

/// Pictures: what every part of `vision` reads.
///
/// Image points are in pixels, x to the right, y downwards, (0, 0) the outer corner of the
/// top-left pixel, so pixel centres lie at (0.5, 0.5), (1.5, 0.5), ...
namespace repose::vision {

struct Point {
  double x = 0;
  double y = 0;
};

struct Segment {
  Point from;
  Point to;
};

/// Rectangle of whole pixels; x, y is its top-left pixel.
struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// 8-bit colour picture, rows from the top, three bytes per pixel in the order blue, green, red.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgr;  ///< width * height * 3 bytes, no padding between rows

  bool empty() const { return width <= 0 || height <= 0; }
};

/// Pictures with more pixels are refused before any memory is allocated.
inline constexpr std::int64_t kMaxPixels = 200'000'000;

/// Reads a JPEG, HEIC, AVIF, PNG, TIFF, BMP or WebP file into upright 8-bit colour.
///
/// EXIF rotation is applied; grey, CMYK, 16-bit and transparent pictures are converted.
/// @throws base::InputError  one line "FILE: what. Fix: ..." if the file is missing, empty, not a
///   picture, damaged, truncated, or claims more than kMaxPixels.
Picture read_picture(const std::filesystem::path& file);

/// Writes a PNG (or JPEG, by the name's ending) atomically.
/// @throws base::InputError  another ending, no pixels, or the file cannot be written.
void write_picture(const std::filesystem::path& file, const Picture& picture);

/// The content of a JPEG file.
/// @param quality  0 to 100
/// @throws base::InputError  the picture has no pixels.
std::vector<std::uint8_t> jpeg_of(const Picture& picture, int quality);

/// The content of a PNG file. Likewise.
std::vector<std::uint8_t> png_of(const Picture& picture);

/// The picture turned clockwise by a multiple of a right angle [deg].
Picture turned(Picture picture, int clockwise_deg);

/// The picture scaled down so that no side is longer than that [px]; smaller ones are unchanged.
Picture reduced(const Picture& picture, int longest_side_px);

}  // namespace repose::vision
