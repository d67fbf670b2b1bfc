#include "vision/video/shown_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <opencv2/core.hpp>
extern "C" {
#include <libavutil/display.h>

#include "base/input_error.h"
}

namespace repose::vision {
namespace {

/// Numbers of the matrix by which a point (x, y, 1) of the stored frame gets its place.
using Matrix = std::array<std::int32_t, 9>;

constexpr const char* kFixShape =
    "ffmpeg -i FILM -vf scale=iw*sar:ih,setsar=1 -crf 12 NEW.mp4 makes such frames.";

/// Of anamorphic lenses and of fields that were stored as frames.
constexpr double kMostAspect = 4;

const std::uint8_t* stored_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVPacketSideData* found =
      av_packet_side_data_get(stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data,
                              AV_PKT_DATA_DISPLAYMATRIX);
  return found ? found->data : nullptr;
#else
  return av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
}

/// How telephones say how they were held.
std::optional<Matrix> display_matrix(const AVStream& stream, const AVFrame* frame) {
  const std::uint8_t* data = stored_matrix(stream);
  if (!data && frame) {
    const AVFrameSideData* found = av_frame_get_side_data(frame, AV_FRAME_DATA_DISPLAYMATRIX);
    data = found ? found->data : nullptr;
  }
  if (!data) return std::nullopt;
  Matrix matrix;
  std::memcpy(matrix.data(), data, sizeof matrix);
  return matrix;
}

/// Only turns by quarters and mirror images, which move no pixel off its grid, are done.
void read_turn(const Matrix& matrix, ShownFrame& shown) {
  const double a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
  const double size = std::hypot(a, b);
  if (size <= 0 && std::hypot(c, d) <= 0) return;  // it says nothing
  constexpr double kOff = 1e-3, kSizeOff = .01;
  const double straight = std::min(std::abs(a), std::abs(d));
  const double across = std::min(std::abs(b), std::abs(c));
  shown.is_transposed = across > straight;
  const double kept = shown.is_transposed ? across : straight;
  const double off =
      shown.is_transposed ? std::max(std::abs(a), std::abs(d)) : std::max(std::abs(b), std::abs(c));
  const double most =
      shown.is_transposed ? std::max(std::abs(b), std::abs(c)) : std::max(std::abs(a), std::abs(d));
  const bool has_perspective = matrix[2] != 0 || matrix[5] != 0;
  if (has_perspective || kept <= 0 || off > kOff * kept || most > (1 + kSizeOff) * kept) {
    throw base::InputError({.value = fmt::format("the film says that its frames are to be shown "
                                                 "turned by {:.1f} degrees, sheared or stretched",
                                                 -av_display_rotation_get(matrix.data())),
                            .rule = "turned by quarters, or mirrored",
                            .fix = "ffmpeg -i FILM -crf 12 NEW.mp4 makes frames that lie as they "
                                   "are shown; check with the overlay that they do."});
  }
  shown.is_mirrored = (shown.is_transposed ? c : a) < 0;
  shown.is_upside_down = (shown.is_transposed ? b : d) < 0;
}

double ratio_of(const AVRational& aspect) {
  return aspect.num > 0 && aspect.den > 0 ? av_q2d(aspect) : 0;
}

double pixel_aspect(const AVStream& stream, const AVFrame* frame) {
  const double container = ratio_of(stream.sample_aspect_ratio);
  const double inner =
      ratio_of(frame ? frame->sample_aspect_ratio : stream.codecpar->sample_aspect_ratio);
  constexpr double kSame = .01;
  if (container > 0 && inner > 0 && std::abs(container / inner - 1) > kSame) {
    throw base::InputError(
        {.value = fmt::format("its container says that pixels are {:.4g} times as wide as high, "
                              "and its frames say {:.4g}",
                              container, inner),
         .rule = "one shape",
         .fix = fmt::format(
             "see by something round which is right, set it, and make pixels square: {}",
             kFixShape)});
  }
  const double aspect = container > 0 ? container : inner;
  if (aspect <= 0) return 1;  // it says nothing
  if (aspect > kMostAspect || aspect < 1 / kMostAspect) {
    throw base::InputError(
        {.value =
             fmt::format("the film says that its pixels are {:.4g} times as wide as high", aspect),
         .rule = fmt::format("{:g} to {:g}", 1 / kMostAspect, kMostAspect),
         .fix = fmt::format("convert it with pixels that are square: {}", kFixShape)});
  }
  return aspect;
}

}  // namespace

int ShownFrame::width_of(int stored_width) const {
  return std::max(1, static_cast<int>(std::lround(stored_width * pixel_aspect)));
}

void ShownFrame::turn(const cv::Mat& lying, cv::Mat& upright) const {
  cv::Mat turned;
  if (is_transposed) {
    cv::transpose(lying, turned);
  } else {
    turned = lying;
  }
  if (!is_mirrored && !is_upside_down) {
    turned.copyTo(upright);
  } else {
    const int both = -1, rows = 0, columns = 1;
    cv::flip(turned, upright, is_mirrored && is_upside_down ? both : is_mirrored ? columns : rows);
  }
}

ShownFrame shown_frame(const AVStream& stream, const AVFrame* frame) {
  ShownFrame shown{.pixel_aspect = pixel_aspect(stream, frame)};
  if (const auto matrix = display_matrix(stream, frame)) read_turn(*matrix, shown);
  return shown;
}

}  // namespace repose::vision
