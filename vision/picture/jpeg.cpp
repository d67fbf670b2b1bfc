#include "vision/picture/jpeg.h"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // before jpeglib.h, which uses FILE and size_t
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <jerror.h>
#include <jpeglib.h>

#include "base/input_error.h"
#include "vision/picture/decoding.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

// Some cameras pad the data before the end marker. More than this was once picture data.
constexpr int kMaxPaddingBytes = 16;

/// The decoder and everything its callbacks need. libjpeg reports an error by calling back and must
/// not return from there, so the functions below leave it with longjmp. Each function that calls
/// setjmp therefore owns nothing that has a destructor: this struct is owned by their caller.
struct JpegDecoder {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf escape{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  JpegDecoder() = default;
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  JpegDecoder(JpegDecoder&&) = delete;
  JpegDecoder& operator=(JpegDecoder&&) = delete;
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg); }
};

JpegDecoder& decoder_of(j_common_ptr jpeg) { return *static_cast<JpegDecoder*>(jpeg->client_data); }

[[noreturn]] void leave(j_common_ptr jpeg) {
  JpegDecoder& decoder = decoder_of(jpeg);
  decoder.errors.format_message(jpeg, decoder.message.data());
  std::longjmp(decoder.escape, 1);
}

bool is_harmless(const jpeg_error_mgr& warning) {
  switch (warning.msg_code) {
    case JWRN_JFIF_MAJOR:
    case JWRN_ADOBE_XFORM:
      return true;
    case JWRN_EXTRANEOUS_DATA:
      return warning.msg_parm.i[0] <= kMaxPaddingBytes && warning.msg_parm.i[1] == JPEG_EOI;
    default:
      return false;
  }
}

/// A negative level is a warning; others are trace messages.
void on_message(j_common_ptr jpeg, int level) {
  if (level < 0 && !is_harmless(*jpeg->err)) leave(jpeg);
}

/// False: it failed and decoder.message says why.
bool read_header(JpegDecoder& decoder, std::span<const std::uint8_t> bytes) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg.err = jpeg_std_error(&decoder.errors);
  jpeg.client_data = &decoder;
  decoder.errors.error_exit = leave;
  decoder.errors.emit_message = on_message;
  if (setjmp(decoder.escape) != 0) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  return true;
}

/// Reads rows of `row_bytes` bytes into `pixels`, in libjpeg's `colours`. False as above.
bool read_rows(JpegDecoder& decoder, J_COLOR_SPACE colours, std::uint8_t* pixels,
               std::size_t row_bytes) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  if (setjmp(decoder.escape) != 0) return false;
  jpeg.out_color_space = colours;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = pixels + row_bytes * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

[[noreturn]] void refuse(const JpegDecoder& decoder) {
  throw base::InputError(
      {.value = fmt::format("the JPEG is truncated or damaged ({})", decoder.message.data()),
       .fix = "copy it from the camera again, or take another picture."});
}

/// Light reflected by inks on white paper. Adobe programs store the inks inverted.
void inks_to_bgr(const std::vector<std::uint8_t>& cmyk, bool inverted, Picture& picture) {
  const auto light = [inverted](std::uint8_t ink) { return inverted ? ink : 255 - ink; };
  for (std::size_t in = 0, out = 0; in < cmyk.size(); in += 4, out += 3) {
    const int key = light(cmyk[in + 3]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int colour = light(cmyk[in + 2 - channel]);
      picture.bgr[out + channel] = static_cast<std::uint8_t>((colour * key + 127) / 255);
    }
  }
}

}  // namespace

Picture decode_jpeg(std::span<const std::uint8_t> bytes) {
  JpegDecoder decoder;
  if (!read_header(decoder, bytes)) refuse(decoder);
  check_claimed_size(decoder.jpeg.image_width, decoder.jpeg.image_height);

  Picture picture = blank_picture(static_cast<int>(decoder.jpeg.image_width),
                                  static_cast<int>(decoder.jpeg.image_height));
  const auto width = static_cast<std::size_t>(picture.width);
  const bool is_ink = decoder.jpeg.num_components == 4;
  if (!is_ink) {
    if (!read_rows(decoder, JCS_EXT_BGR, picture.bgr.data(), 3 * width)) refuse(decoder);
    return picture;
  }
  std::vector<std::uint8_t> cmyk(4 * width * static_cast<std::size_t>(picture.height));
  if (!read_rows(decoder, JCS_CMYK, cmyk.data(), 4 * width)) refuse(decoder);
  inks_to_bgr(cmyk, decoder.jpeg.saw_Adobe_marker, picture);
  return picture;
}

namespace {

/// As JpegDecoder: libjpeg leaves a failed call with longjmp, so the function that calls setjmp
/// owns nothing with a destructor.
struct JpegEncoder {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf escape{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  unsigned char* coded = nullptr;
  unsigned long coded_bytes = 0;

  JpegEncoder() = default;
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;
  JpegEncoder(JpegEncoder&&) = delete;
  JpegEncoder& operator=(JpegEncoder&&) = delete;
  ~JpegEncoder() {
    jpeg_destroy_compress(&jpeg);
    std::free(coded);
  }
};

[[noreturn]] void leave_encoder(j_common_ptr jpeg) {
  auto& encoder = *static_cast<JpegEncoder*>(jpeg->client_data);
  encoder.errors.format_message(jpeg, encoder.message.data());
  std::longjmp(encoder.escape, 1);
}

/// False: it failed and encoder.message says why.
bool encode(JpegEncoder& encoder, const Picture& picture, int quality) {
  jpeg_compress_struct& jpeg = encoder.jpeg;
  jpeg.err = jpeg_std_error(&encoder.errors);
  jpeg.client_data = &encoder;
  encoder.errors.error_exit = leave_encoder;
  if (setjmp(encoder.escape) != 0) return false;
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &encoder.coded, &encoder.coded_bytes);
  jpeg.image_width = static_cast<JDIMENSION>(picture.width);
  jpeg.image_height = static_cast<JDIMENSION>(picture.height);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_EXT_BGR;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(picture.width);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<JSAMPROW>(picture.bgr.data() + row_bytes * jpeg.next_scanline);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality) {
  JpegEncoder encoder;
  if (!encode(encoder, picture, quality)) {
    throw base::InputError(
        {.value = fmt::format("a picture of {} x {} pixels cannot be written as JPEG ({})",
                              picture.width, picture.height, encoder.message.data()),
         .fix = "let the name end in .png."});
  }
  return {encoder.coded, encoder.coded + encoder.coded_bytes};
}

}  // namespace repose::vision
