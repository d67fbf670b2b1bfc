#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // before jpeglib.h, which uses FILE and size_t
#include <cstdlib>

#include <fmt/format.h>
#include <jpeglib.h>

#include "base/input_error.h"
#include "vision/picture/jpeg.h"

namespace repose::vision {
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
