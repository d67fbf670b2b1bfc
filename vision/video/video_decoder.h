#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/picture/ffmpeg.h"

namespace repose::vision {

/// The pictures of a film file in their order. Neither a frame rate nor a number of frames that a
/// file claims need be true.
class VideoDecoder {
 public:
  /// @throws std::invalid_argument  "FILE: what. Fix: ...": damaged, or of an unknown kind.
  explicit VideoDecoder(const std::filesystem::path& file);

  int width() const;
  int height() const;
  std::optional<double> claimed_frames_per_s() const;
  /// 0 where the file does not say.
  std::int64_t claimed_frames() const;

  /// Decodes the next picture. False at the end, which is where nothing more can be decoded.
  bool advance();
  /// When the picture is shown, where the file says so: from any start on.
  std::optional<double> time_stamp_s() const;
  /// The picture, upright, into memory that is used again for the next one.
  /// @throws std::invalid_argument  "FILE: what. Fix: ..."
  void copy_to(cv::Mat& bgr);

 private:
  bool send_next_packet();

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
