#include "vision/picture/other_formats.h"

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <tiffio.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include "base/input_error.h"
#include "vision/picture/decoding.h"
#include "vision/picture/ffmpeg.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kHeaderBytes = 54;  // file header and the usual info header

std::uint32_t number_at(Bytes bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

[[noreturn]] void refuse_damaged_bmp() {
  throw base::InputError({.value = "the BMP is truncated or damaged",
                          .fix = "copy it from its source again, or save it as PNG."});
}

/// The decoder accepts an incomplete palette, so it is checked first.
void check_palette(Bytes bytes) {
  constexpr std::int64_t kFileHeaderBytes = 14, kMaxColours = 256, kColourBytes = 4;
  const std::int64_t bits_per_pixel = bytes[28];
  if (bits_per_pixel > 8) return;
  const std::int64_t said = number_at(bytes, 46);
  const std::int64_t colours = said > 0 ? said : std::int64_t{1} << bits_per_pixel;
  const std::int64_t from = kFileHeaderBytes + number_at(bytes, 14);
  if (colours > kMaxColours || from + kColourBytes * colours > number_at(bytes, 10)) {
    refuse_damaged_bmp();
  }
}

/// The decoder accepts files that are too short, so the length is checked first.
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
  // A colour profile may follow the pixels; then the header says how many bytes the pixels take.
  constexpr std::int64_t kMaxPadding = 4;
  const std::int64_t behind = static_cast<std::int64_t>(bytes.size()) - pixels_from;
  const std::int64_t said = number_at(bytes, 34);
  if (behind - row_bytes * height > kMaxPadding && said != row_bytes * height) {
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

namespace {

int orientation_of(std::span<const std::uint8_t> bytes) {
  const WebPData data{bytes.data(), bytes.size()};
  const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> demuxer(WebPDemux(&data),
                                                                         &WebPDemuxDelete);
  WebPChunkIterator chunk;
  if (!demuxer || !WebPDemuxGetChunk(demuxer.get(), "EXIF", 1, &chunk)) return kUprightOrientation;
  const int orientation = exif_block_orientation({chunk.chunk.bytes, chunk.chunk.size});
  WebPDemuxReleaseChunkIterator(&chunk);
  return orientation;
}

[[noreturn]] void refuse_damaged_webp() {
  throw base::InputError(
      {.value = "the WebP is truncated or damaged", .fix = "copy it from its source again."});
}

}  // namespace

/// RIFF gives its own length, without its first eight bytes. One padding byte is allowed.
void check_webp_length(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kLengthAt = 4, kHeader = 8;
  if (bytes.size() < kLengthAt + sizeof(std::uint32_t)) refuse_damaged_webp();
  std::uint64_t length = kHeader;
  for (std::size_t k = 0; k < sizeof(std::uint32_t); ++k) {
    length += std::uint64_t{bytes[kLengthAt + k]} << (8 * k);
  }
  if (length != bytes.size() && length + 1 != bytes.size()) refuse_damaged_webp();
}

Picture decode_webp(std::span<const std::uint8_t> bytes) {
  check_webp_length(bytes);
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
    refuse_damaged_webp();
  if (features.has_animation) {
    throw base::InputError({.value = "is an animated picture", .fix = "save one frame as PNG."});
  }
  check_claimed_size(features.width, features.height);

  cv::Mat samples(features.height, features.width, features.has_alpha ? CV_8UC4 : CV_8UC3);
  const auto decode = features.has_alpha ? WebPDecodeBGRAInto : WebPDecodeBGRInto;
  if (!decode(bytes.data(), bytes.size(), samples.data, samples.total() * samples.elemSize(),
              static_cast<int>(samples.step))) {
    refuse_damaged_webp();
  }
  return turned_upright(flatten(samples), orientation_of(bytes));
}

namespace {

/// The bytes that libtiff reads, and the first error that it reports.
struct Source {
  std::span<const std::uint8_t> bytes;
  std::uint64_t position = 0;
  std::string error;
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t on_read(thandle_t handle, void* to, tmsize_t count) {
  Source& source = source_of(handle);
  if (source.position >= source.bytes.size()) return 0;
  const auto rest = source.bytes.subspan(source.position);
  const std::size_t read = std::min(static_cast<std::size_t>(count), rest.size());
  std::copy_n(rest.begin(), read, static_cast<std::uint8_t*>(to));
  source.position += read;
  return static_cast<tmsize_t>(read);
}

tmsize_t on_write(thandle_t, void*, tmsize_t) { return 0; }

toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = source_of(handle);
  if (whence == SEEK_CUR) offset += source.position;
  if (whence == SEEK_END) offset += source.bytes.size();
  return source.position = offset;
}

int on_close(thandle_t) { return 0; }

toff_t on_size(thandle_t handle) { return source_of(handle).bytes.size(); }

/// Returns 1: handled; in particular, nothing is printed.
int on_error(TIFF*, void* user, const char*, const char* format, std::va_list arguments) {
  auto& error = static_cast<Source*>(user)->error;
  if (!error.empty()) return 1;
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  error = text;
  return 1;
}

/// Warnings are about unknown tags.
int on_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

using File = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

File open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, nullptr);
  // "m": no memory mapping, as there is no file.
  return File(TIFFClientOpenExt("picture", "rm", &source, on_read, on_write, on_seek, on_close,
                                on_size, nullptr, nullptr, options.get()),
              &TIFFClose);
}

[[noreturn]] void refuse_damaged(const Source& source) {
  throw base::InputError(
      {.value = fmt::format("the TIFF is truncated or damaged ({})",
                            source.error.empty() ? "no picture in it" : source.error),
       .fix = "copy it from where it came from again, or save it as PNG."});
}

/// A tag of the file, or the standard's default if it is missing.
template <typename Value>
Value tag(const File& file, std::uint32_t name, Value missing = 0) {
  Value value = missing;
  TIFFGetFieldDefaulted(file.get(), name, &value);
  return value;
}

struct Layout {
  int bits = 0;
  int channels = 0;
  std::uint16_t colours = 0;
  bool is_rows_of_whole_pixels = false;  ///< not tiled, channels interleaved
  bool is_integer = true;

  /// Whether it can be read sample by sample, which keeps 16 bits and alpha unchanged.
  bool is_plain() const {
    const bool is_grey = colours == PHOTOMETRIC_MINISBLACK || colours == PHOTOMETRIC_MINISWHITE;
    const bool fits = (is_grey && channels == 1) ||
                      (colours == PHOTOMETRIC_RGB && (channels == 3 || channels == 4));
    return fits && is_rows_of_whole_pixels && (bits == 8 || bits == 16);
  }
};

Layout layout_of(const File& file) {
  const auto sample_format = tag<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  return {
      .bits = tag<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE),
      .channels = tag<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL),
      .colours = tag<std::uint16_t>(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK),
      .is_rows_of_whole_pixels =
          !TIFFIsTiled(file.get()) &&
          tag<std::uint16_t>(file, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG,
      .is_integer = sample_format == SAMPLEFORMAT_UINT,
  };
}

/// Bytes of all strips or tiles together, as the file lists them.
std::int64_t listed_bytes(const File& file) {
  const bool is_tiled = TIFFIsTiled(file.get()) != 0;
  const std::uint32_t parts =
      is_tiled ? TIFFNumberOfTiles(file.get()) : TIFFNumberOfStrips(file.get());
  std::int64_t sum = 0;
  for (std::uint32_t part = 0; part < parts; ++part) {
    sum += static_cast<std::int64_t>(TIFFGetStrileByteCount(file.get(), part));
  }
  return sum;
}

/// The number of bytes is known only for uncompressed pixels.
void check_bytes(const File& file, std::int64_t width, std::int64_t height) {
  if (tag<std::uint16_t>(file, TIFFTAG_COMPRESSION, COMPRESSION_NONE) != COMPRESSION_NONE) return;
  const std::int64_t listed = listed_bytes(file);
  if (TIFFIsTiled(file.get())) {
    check_claimed_bytes(
        width, height,
        static_cast<std::int64_t>(TIFFNumberOfTiles(file.get()) * TIFFTileSize64(file.get())),
        listed);
    return;
  }
  const bool is_apart = tag<std::uint16_t>(file, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  const std::int64_t planes = is_apart ? tag<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL) : 1;
  const auto rows = static_cast<std::uint32_t>(height);
  const auto plane = static_cast<std::int64_t>(TIFFVStripSize64(file.get(), rows));
  const std::int64_t whole_strips = static_cast<std::int64_t>(TIFFNumberOfStrips(file.get())) *
                                    static_cast<std::int64_t>(TIFFStripSize64(file.get()));
  if (listed == whole_strips) return;  // the last one padded too, as some programs write it
  check_claimed_bytes(width, height, planes * plane, listed);
}

cv::Mat read_plain(const File& file, const Source& source, const Layout& layout, cv::Size size) {
  const int depth = layout.bits == 16 ? CV_16U : CV_8U;
  cv::Mat samples(size, CV_MAKETYPE(depth, layout.channels));
  for (int y = 0; y < size.height; ++y) {
    if (TIFFReadScanline(file.get(), samples.ptr(y), static_cast<std::uint32_t>(y)) < 0) {
      refuse_damaged(source);
    }
  }
  if (layout.colours == PHOTOMETRIC_MINISWHITE) cv::bitwise_not(samples, samples);
  if (layout.channels == 3) cv::cvtColor(samples, samples, cv::COLOR_RGB2BGR);
  if (layout.channels == 4) cv::cvtColor(samples, samples, cv::COLOR_RGBA2BGRA);
  return samples;
}

/// Everything else through libtiff's own conversion to 8 bits. It premultiplies the colours by
/// alpha, so dropping alpha composites them over black.
cv::Mat read_converted(const File& file, const Source& source, cv::Size size, int orientation) {
  char why_not[1024];
  if (!TIFFRGBAImageOK(file.get(), why_not)) {
    throw base::InputError({.value = fmt::format("this kind of TIFF cannot be read ({})", why_not),
                            .fix = "save it as PNG."});
  }
  cv::Mat rgba(size, CV_8UC4);
  constexpr int kStopAtErrors = 1;
  // Requested as stored: libtiff does not turn pictures that lie on their side.
  if (!TIFFReadRGBAImageOriented(file.get(), static_cast<std::uint32_t>(size.width),
                                 static_cast<std::uint32_t>(size.height), rgba.ptr<std::uint32_t>(),
                                 orientation, kStopAtErrors)) {
    refuse_damaged(source);
  }
  cv::Mat bgr;
  cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
  return bgr;
}

/// Scanners and editors write several pages to one file: smaller previews, or further pictures,
/// among which only the user can choose.
void turn_to_largest_page(const File& file) {
  constexpr int kMostPages = 10000;
  std::int64_t largest = -1;
  std::uint32_t width = 0, height = 0;
  int page_of_largest = 0, as_large = 0, pages = 0;
  do {
    const auto w = tag<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH);
    const auto h = tag<std::uint32_t>(file, TIFFTAG_IMAGELENGTH);
    const std::int64_t pixels = std::int64_t{w} * h;
    if (pixels > largest) {
      largest = pixels, width = w, height = h;
      page_of_largest = pages;
      as_large = 0;
    }
    as_large += pixels == largest ? 1 : 0;
  } while (++pages < kMostPages && TIFFReadDirectory(file.get()) != 0);
  if (as_large > 1) {
    throw base::InputError(
        {.value = fmt::format("holds {} pages of {} x {} pixels", as_large, width, height),
         .rule = "one picture a file, with smaller previews at most",
         .fix = "save the page that shows the heap as a file of its own."});
  }
  if (pages > 1) TIFFSetDirectory(file.get(), static_cast<tdir_t>(page_of_largest));
}

}  // namespace

Picture decode_tiff(std::span<const std::uint8_t> bytes) {
  Source source{.bytes = bytes, .position = 0, .error = {}};
  const File file = open(source);
  if (!file) refuse_damaged(source);
  turn_to_largest_page(file);
  const auto width = tag<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH);
  const auto height = tag<std::uint32_t>(file, TIFFTAG_IMAGELENGTH);
  check_claimed_size(width, height);
  const Layout layout = layout_of(file);
  if (!layout.is_integer || layout.bits > 16) {
    throw base::InputError(
        {.value = fmt::format("a TIFF of {}-bit {} samples cannot be read", layout.bits,
                              layout.is_integer ? "whole" : "signed or floating-point"),
         .fix = "save it with 8 or 16 bits."});
  }
  check_bytes(file, width, height);
  const cv::Size size(static_cast<int>(width), static_cast<int>(height));
  const int orientation = tag<std::uint16_t>(file, TIFFTAG_ORIENTATION, kUprightOrientation);
  const cv::Mat samples = layout.is_plain() ? read_plain(file, source, layout, size)
                                            : read_converted(file, source, size, orientation);
  return turned_upright(flatten(samples), orientation);
}

}  // namespace repose::vision
