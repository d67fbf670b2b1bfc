#include "vision/picture/png.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core/mat.hpp>
#include <png.h>
#include <zlib.h>

#include "base/input_error.h"
#include "vision/picture/decoding.h"

namespace repose::vision {

namespace {

/// The decoder and everything its callbacks need. libpng leaves a failed call with longjmp, so the
/// functions below that call setjmp own nothing with a destructor: their caller owns this struct.
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

/// Warnings concern metadata only: colour profiles, dates.
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

/// Requests BGR or BGRA of 8 or 16 bits. False as above.
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

namespace {

constexpr int kCompression = 1;  // 9 takes ten times as long for a tenth less space

/// As PngDecoder: libpng leaves a failed call with longjmp, so the function that calls setjmp owns
/// nothing with a destructor.
struct PngEncoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint8_t> coded;
  std::array<char, 200> message{};

  PngEncoder() = default;
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;
  PngEncoder(PngEncoder&&) = delete;
  PngEncoder& operator=(PngEncoder&&) = delete;
  ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void leave_encoder(png_structp png, png_const_charp message) {
  auto& encoder = *static_cast<PngEncoder*>(png_get_error_ptr(png));
  fmt::format_to_n(encoder.message.data(), encoder.message.size() - 1, "{}", message);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep bytes, std::size_t count) {
  auto& coded = static_cast<PngEncoder*>(png_get_io_ptr(png))->coded;
  coded.insert(coded.end(), bytes, bytes + count);
}

/// False: it failed and encoder.message says why.
bool encode(PngEncoder& encoder, const Picture& picture) {
  encoder.png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, leave_encoder, ignore_warning);
  if (!encoder.png) return false;
  if (setjmp(png_jmpbuf(encoder.png)) != 0) return false;
  encoder.info = png_create_info_struct(encoder.png);
  if (!encoder.info) return false;
  png_set_write_fn(encoder.png, &encoder, append, nullptr);
  png_set_compression_level(encoder.png, kCompression);
  png_set_compression_strategy(encoder.png, Z_DEFAULT_STRATEGY);
  png_set_IHDR(encoder.png, encoder.info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(encoder.png, encoder.info);
  png_set_bgr(encoder.png);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(picture.width);
  for (std::size_t from = 0; from < picture.bgr.size(); from += row_bytes) {
    png_write_row(encoder.png, picture.bgr.data() + from);
  }
  png_write_end(encoder.png, encoder.info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  PngEncoder encoder;
  if (encode(encoder, picture)) return encoder.coded;
  throw base::InputError(
      {.value = fmt::format("a picture of {} x {} pixels cannot be written as PNG ({})",
                            picture.width, picture.height, encoder.message.data()),
       .fix = "make it smaller."});
}

}  // namespace repose::vision
