#include "vision/picture/bmp.h"

#include <cstddef>
#include <cstdlib>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "vision/picture/claimed_size.h"
#include "vision/picture/flatten.h"

namespace repose::vision {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kHeaderBytes = 54;  // file header and the header every program writes

std::uint32_t number_at(Bytes bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

[[noreturn]] void refuse_damaged_bmp() {
  throw std::invalid_argument(
      "the BMP is truncated or damaged. Fix: copy it from its source again, or save it as "
      "PNG.");
}

/// OpenCV prints to stderr what is wrong with a palette, so it is checked before.
void check_palette(Bytes bytes) {
  constexpr std::int64_t kFileHeaderBytes = 14, kMostColours = 256, kColourBytes = 4;
  const std::int64_t bits_per_pixel = bytes[28];
  if (bits_per_pixel > 8) return;
  const std::int64_t said = number_at(bytes, 46);
  const std::int64_t colours = said > 0 ? said : std::int64_t{1} << bits_per_pixel;
  const std::int64_t from = kFileHeaderBytes + number_at(bytes, 14);
  if (colours > kMostColours || from + kColourBytes * colours > number_at(bytes, 10)) {
    refuse_damaged_bmp();
  }
}

/// OpenCV prints to stderr when the data end early, so their length is checked before.
void check_bmp_length(Bytes bytes) {
  if (bytes.size() < kHeaderBytes) refuse_damaged_bmp();
  const std::int64_t pixels_from = number_at(bytes, 10);
  const std::int64_t width = static_cast<std::int32_t>(number_at(bytes, 18));
  const std::int64_t height =
      std::abs(std::int64_t{static_cast<std::int32_t>(number_at(bytes, 22))});
  check_claimed_size(width, height);
  const std::int64_t bits_per_pixel = bytes[28];
  constexpr std::uint32_t kPlain = 0, kBitFields = 3;
  const std::uint32_t coding = number_at(bytes, 30);
  if (coding != kPlain && coding != kBitFields) {
    throw std::invalid_argument("a compressed BMP cannot be read. Fix: save it as PNG.");
  }
  const std::int64_t row_bytes = (width * bits_per_pixel + 31) / 32 * 4;  // whole 32-bit words
  if (bits_per_pixel == 0 || pixels_from < static_cast<std::int64_t>(kHeaderBytes) ||
      pixels_from + row_bytes * height > static_cast<std::int64_t>(bytes.size())) {
    refuse_damaged_bmp();
  }
  // What follows the pixels may be a colour profile; then the header says how many bytes they take.
  constexpr std::int64_t kMostPadding = 4;
  const std::int64_t behind = static_cast<std::int64_t>(bytes.size()) - pixels_from;
  const std::int64_t said = number_at(bytes, 34);
  if (behind - row_bytes * height > kMostPadding && said != row_bytes * height) {
    check_claimed_bytes(width, height, row_bytes * height, said > 0 ? said : behind);
  }
}

}  // namespace

Picture decode_bmp(Bytes bytes) {
  check_bmp_length(bytes);
  check_palette(bytes);
  const cv::Mat coded(1, static_cast<int>(bytes.size()), CV_8U,
                      const_cast<std::uint8_t*>(bytes.data()));
  const cv::Mat samples = cv::imdecode(coded, cv::IMREAD_COLOR);
  if (samples.empty()) refuse_damaged_bmp();
  return flatten(samples);
}

}  // namespace repose::vision
