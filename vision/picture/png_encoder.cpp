#include <array>
#include <cstddef>

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include "base/input_error.h"
#include "vision/picture/png.h"

namespace repose::vision {
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
