#include "vision/picture/png.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core/mat.hpp>
#include <png.h>

#include "base/input_error.h"
#include "vision/picture/claimed_size.h"
#include "vision/picture/flatten.h"
#include "vision/picture/upright.h"

namespace repose::vision {
namespace {

/// The decoder and all that its callbacks need. libpng leaves a failed call with longjmp, so the
/// functions below that call setjmp own nothing with a destructor: this struct is their caller's.
struct PngDecoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::span<const std::uint8_t> unread;
  std::array<char, 200> message{};

  PngDecoder() = default;
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  PngDecoder(PngDecoder&&) = delete;
  PngDecoder& operator=(PngDecoder&&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto& decoder = *static_cast<PngDecoder*>(png_get_error_ptr(png));
  fmt::format_to_n(decoder.message.data(), decoder.message.size() - 1, "{}", message);
  png_longjmp(png, 1);
}

/// Warnings are about metadata: colour profiles, dates.
void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, std::size_t count) {
  auto& unread = static_cast<PngDecoder*>(png_get_io_ptr(png))->unread;
  if (count > unread.size()) png_error(png, "it ends early");
  std::copy_n(unread.begin(), count, to);
  unread = unread.subspan(count);
}

/// False: it failed and decoder.message says why.
bool read_header(PngDecoder& decoder) {
  decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoder, on_error, on_warning);
  if (!decoder.png) return false;
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  decoder.info = png_create_info_struct(decoder.png);
  if (!decoder.info) return false;
  png_set_read_fn(decoder.png, &decoder, on_read);
  png_read_info(decoder.png, decoder.info);
  return true;
}

/// Asks for BGR or BGRA of 8 or 16 bits. False as above.
bool choose_samples(PngDecoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_expand(decoder.png);
  png_set_gray_to_rgb(decoder.png);
  png_set_bgr(decoder.png);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(decoder.png);
  png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  return true;
}

/// False as above.
bool read_rows(PngDecoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_image(decoder.png, rows);
  png_read_end(decoder.png, decoder.info);
  return true;
}

int orientation_of(const PngDecoder& decoder) {
  png_bytep block = nullptr;
  png_uint_32 size = 0;
  if (!png_get_eXIf_1(decoder.png, decoder.info, &size, &block)) return kUprightOrientation;
  return exif_block_orientation({block, size});
}

void require(bool worked, const PngDecoder& decoder) {
  if (worked) return;
  throw base::InputError(
      {.value = fmt::format("the PNG is truncated or damaged ({})", decoder.message.data()),
       .fix = "copy it from where it came from again."});
}

}  // namespace

Picture decode_png(std::span<const std::uint8_t> bytes) {
  PngDecoder decoder;
  decoder.unread = bytes;
  require(read_header(decoder), decoder);
  const png_uint_32 width = png_get_image_width(decoder.png, decoder.info);
  const png_uint_32 height = png_get_image_height(decoder.png, decoder.info);
  check_claimed_size(width, height);

  require(choose_samples(decoder), decoder);
  const int depth = png_get_bit_depth(decoder.png, decoder.info) == 16 ? CV_16U : CV_8U;
  const int channels = png_get_channels(decoder.png, decoder.info);
  cv::Mat samples(static_cast<int>(height), static_cast<int>(width), CV_MAKETYPE(depth, channels));
  std::vector<png_bytep> rows(height);
  for (int y = 0; y < samples.rows; ++y) rows[static_cast<std::size_t>(y)] = samples.ptr(y);
  require(read_rows(decoder, rows.data()), decoder);
  return turned_upright(flatten(samples), orientation_of(decoder));
}

}  // namespace repose::vision
