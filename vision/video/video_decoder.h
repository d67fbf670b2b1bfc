#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/picture/ffmpeg.h"

namespace repose::vision {

/// How a film says that its stored frames are to be shown. Rows stay as the camera read them: of
/// pixels that are not square the width is stretched.
struct ShownFrame {
  double pixel_aspect = 1;  ///< width of a stored pixel over its height
  /// In this order: rows become columns, left becomes right, top becomes bottom.
  bool is_transposed = false;
  bool is_mirrored = false;
  bool is_upside_down = false;

  /// Of stored frames of this width, when their pixels are made square.
  int width_of(int stored_width) const;
  /// Turns a frame of square pixels.
  void turn(const cv::Mat& lying, cv::Mat& upright) const;
};

/// By the container, else by the frame itself.
/// @param frame  decoded; null: none is yet
/// @throws base::InputError  "what. Fix: ...": the film says that frames are to be shown
///   sheared, or turned by no quarter, or that pixels have shapes that no camera makes; or its
///   container and its frames say different shapes.
ShownFrame shown_frame(const AVStream& stream, const AVFrame* frame);

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
