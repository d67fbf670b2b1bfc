#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/picture/ffmpeg.h"
#include "vision/video/shown_frame.h"

namespace repose::vision {

/// The pictures of a film file in their order. Neither a frame rate nor a number of frames that a
/// file claims need be true.
class VideoDecoder {
 public:
  /// @throws base::InputError  "FILE: what. Fix: ...": damaged, of an unknown kind, or sound.
  explicit VideoDecoder(const std::filesystem::path& file);

  /// Of a picture as it is shown.
  /// @throws base::InputError  as copy_to()
  double claimed_pixels() const;
  std::optional<double> claimed_frames_per_s() const;
  /// 0 where the file does not say.
  std::int64_t claimed_frames() const;

  /// Decodes the next picture. False at the end, which is where nothing more can be decoded.
  bool advance();
  /// When the picture is shown, where the file says so: from any start on.
  std::optional<double> time_stamp_s() const;
  /// What time stamps are multiples of: MKV has whole milliseconds, GIF hundredths of a second.
  double stamp_unit_s() const;
  /// The picture as it is to be shown: upright, of square pixels, into memory that is used again
  /// for the next one.
  /// @throws base::InputError  "FILE: what. Fix: ...": see shown_frame()
  void copy_to(cv::Mat& bgr);

 private:
  bool send_next_packet();
  ShownFrame shown(const AVFrame* frame) const;

  std::filesystem::path file_;
  ffmpeg::Input input_;
  AVStream* stream_ = nullptr;  ///< of input_
  ffmpeg::Codec codec_;
  ffmpeg::Packet packet_;
  ffmpeg::Frame frame_;
  ffmpeg::Frame bgr_;
  ffmpeg::Conversion to_bgr_;
};

}  // namespace repose::vision
