#include "vision/picture/bmp.h"

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" {
#include <libavutil/imgutils.h>
}

#include "base/input_error.h"
#include "vision/picture/claimed_size.h"
#include "vision/picture/ffmpeg.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kHeaderBytes = 54;  // file header and the header every program writes

std::uint32_t number_at(Bytes bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

[[noreturn]] void refuse_damaged_bmp() {
  throw base::InputError({.value = "the BMP is truncated or damaged",
                          .fix = "copy it from its source again, or save it as PNG."});
}

/// The decoder does without what a palette lacks, so it is checked before.
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

/// The decoder takes a smaller size for the right one, so it is checked before.
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
    throw base::InputError({.value = "a compressed BMP cannot be read", .fix = "save it as PNG."});
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

ffmpeg::Frame decoded(Bytes bytes) {
  const auto* decoder = avcodec_find_decoder(AV_CODEC_ID_BMP);
  const ffmpeg::Codec codec(avcodec_alloc_context3(decoder));
  const ffmpeg::Packet packet = ffmpeg::empty_packet();
  if (!codec || av_new_packet(packet.get(), static_cast<int>(bytes.size())) < 0) {
    throw std::bad_alloc();
  }
  std::memcpy(packet->data, bytes.data(), bytes.size());
  ffmpeg::Frame frame = ffmpeg::empty_frame();
  if (!decoder || avcodec_open2(codec.get(), decoder, nullptr) < 0 ||
      avcodec_send_packet(codec.get(), packet.get()) < 0 ||
      avcodec_receive_frame(codec.get(), frame.get()) < 0) {
    refuse_damaged_bmp();
  }
  return frame;
}

}  // namespace

Picture decode_bmp(Bytes bytes) {
  check_bmp_length(bytes);
  check_palette(bytes);
  ffmpeg::silence();
  const ffmpeg::Frame frame = decoded(bytes);
  const ffmpeg::Frame bgr = ffmpeg::blank_frame(frame->width, frame->height, AV_PIX_FMT_BGR24);
  ffmpeg::Conversion().run(*frame, *bgr);
  Picture picture = blank_picture(frame->width, frame->height);
  const int row_bytes = 3 * picture.width;
  av_image_copy_plane(picture.bgr.data(), row_bytes, bgr->data[0], bgr->linesize[0], row_bytes,
                      picture.height);
  return picture;
}

}  // namespace repose::vision
