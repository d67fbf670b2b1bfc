#include "vision/picture/webp.h"

#include <cstddef>
#include <cstdint>
#include <memory>

#include <opencv2/core/mat.hpp>
#include <webp/decode.h>
#include <webp/demux.h>

#include "base/input_error.h"
#include "vision/picture/claimed_size.h"
#include "vision/picture/flatten.h"
#include "vision/picture/upright.h"

namespace repose::vision {
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

/// RIFF says how long it is, but for its own first eight bytes. One byte may fill up.
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

}  // namespace repose::vision
