#include "vision/video/video_decoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"

namespace repose::vision {

namespace {

/// The matrix that maps a point (x, y, 1) of the stored frame to its place.
using Matrix = std::array<std::int32_t, 9>;

constexpr const char* kFixShape =
    "ffmpeg -i FILM -vf scale=iw*sar:ih,setsar=1 -crf 12 NEW.mp4 makes such frames.";

/// Covers anamorphic lenses and fields stored as frames.
constexpr double kMaxAspect = 4;

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

/// The matrix by which phones record how they were held.
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

/// Only quarter turns and mirror images, which keep pixels on the grid, are supported.
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
  if (aspect > kMaxAspect || aspect < 1 / kMaxAspect) {
    throw base::InputError(
        {.value =
             fmt::format("the film says that its pixels are {:.4g} times as wide as high", aspect),
         .rule = fmt::format("{:g} to {:g}", 1 / kMaxAspect, kMaxAspect),
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

namespace {

/// After this many damaged packets in a row, the rest of a film is given up.
constexpr int kMaxDamaged = 512;

[[noreturn]] void refuse_film(const std::filesystem::path& file) {
  base::refuse(file, "the film cannot be decoded: it is damaged, or of an unknown kind",
               "copy it from the telephone again, or convert it to MP4 (H.264).");
}

/// A still picture of a sound file, such as an album cover.
bool is_cover(const AVStream& stream) {
  return (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
}

[[noreturn]] void refuse_sound(const AVFormatContext& input, const std::filesystem::path& file) {
  for (unsigned k = 0; k < input.nb_streams; ++k) {
    if (input.streams[k]->codecpar->codec_type != AVMEDIA_TYPE_AUDIO) continue;
    base::refuse(file, "has sound and no moving picture",
                 "name the film itself; where the camera stored pictures and "
                 "sound apart, that of the pictures.");
  }
  refuse_film(file);
}

/// Opens files only, and no formats that refer to other files or addresses.
ffmpeg::Input opened(const std::filesystem::path& file) {
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", "mov,matroska,webm,avi,gif", 0);
  AVFormatContext* format = nullptr;
  const int result =
      avformat_open_input(&format, ("file:" + file.string()).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (result < 0) refuse_film(file);
  return ffmpeg::Input(format);
}

/// @returns nullptr if it cannot be opened
ffmpeg::Codec decoder_of(const AVStream& stream) {
  ffmpeg::Codec codec(avcodec_alloc_context3(nullptr));
  if (!codec) throw std::bad_alloc();
  codec->thread_count = 0;  // one per processor
  if (avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
  const auto* decoder = avcodec_find_decoder(stream.codecpar->codec_id);
  if (!decoder || avcodec_open2(codec.get(), decoder, nullptr) < 0) return nullptr;
  return codec;
}

}  // namespace

VideoDecoder::VideoDecoder(const std::filesystem::path& file)
    : file_(file), packet_(ffmpeg::empty_packet()), frame_(ffmpeg::empty_frame()) {
  ffmpeg::silence();
  input_ = opened(file);
  if (avformat_find_stream_info(input_.get(), nullptr) < 0) refuse_film(file);
  const int best = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (best < 0 || is_cover(*input_->streams[best])) refuse_sound(*input_, file);
  stream_ = input_->streams[best];
  codec_ = decoder_of(*stream_);
  if (!codec_) refuse_film(file);
}

ShownFrame VideoDecoder::shown(const AVFrame* frame) const {
  try {
    return shown_frame(*stream_, frame);
  } catch (const base::InputError& error) {
    throw error.in(file_.string());
  }
}

double VideoDecoder::claimed_pixels() const {
  return static_cast<double>(shown(nullptr).width_of(codec_->width)) * codec_->height;
}

double VideoDecoder::stamp_unit_s() const { return av_q2d(stream_->time_base); }

std::optional<double> VideoDecoder::claimed_frames_per_s() const {
  const double rate = av_q2d(av_guess_frame_rate(input_.get(), stream_, nullptr));
  return std::isfinite(rate) && rate > 0 ? std::optional(rate) : std::nullopt;
}

std::int64_t VideoDecoder::claimed_frames() const {
  if (stream_->nb_frames > 0) return stream_->nb_frames;
  if (input_->duration <= 0) return 0;
  return std::llround(static_cast<double>(input_->duration) / AV_TIME_BASE *
                      claimed_frames_per_s().value_or(0));
}

/// At the end sends an empty packet, which makes the decoder return its remaining frames.
bool VideoDecoder::send_next_packet() {
  while (av_read_frame(input_.get(), packet_.get()) >= 0) {
    const bool is_picture = packet_->stream_index == stream_->index;
    const bool is_good = !is_picture || avcodec_send_packet(codec_.get(), packet_.get()) >= 0;
    av_packet_unref(packet_.get());
    if (is_picture) return is_good;
  }
  return avcodec_send_packet(codec_.get(), nullptr) >= 0;
}

bool VideoDecoder::advance() {
  for (int damaged = 0; damaged < kMaxDamaged;) {
    const int result = avcodec_receive_frame(codec_.get(), frame_.get());
    if (result == 0) return true;
    if (result == AVERROR_EOF) return false;
    if (result != AVERROR(EAGAIN) || !send_next_packet()) ++damaged;
  }
  return false;
}

std::optional<double> VideoDecoder::time_stamp_s() const {
  const std::int64_t stamp = frame_->best_effort_timestamp;
  if (stamp == AV_NOPTS_VALUE) return std::nullopt;
  return static_cast<double>(stamp) * av_q2d(stream_->time_base);
}

void VideoDecoder::copy_to(cv::Mat& bgr) {
  const ShownFrame shown = this->shown(frame_.get());
  const int width = shown.width_of(frame_->width);
  if (!bgr_ || bgr_->width != width || bgr_->height != frame_->height) {
    bgr_ = ffmpeg::blank_frame(width, frame_->height, AV_PIX_FMT_BGR24);
  }
  try {
    to_bgr_.run(*frame_, *bgr_);
  } catch (const base::InputError& error) {
    throw error.in(file_.string());
  }
  const cv::Mat padded(bgr_->height, bgr_->width, CV_8UC3, bgr_->data[0],
                       static_cast<std::size_t>(bgr_->linesize[0]));
  shown.turn(padded, bgr);
}

}  // namespace repose::vision
