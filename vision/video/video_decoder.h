#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/picture/ffmpeg.h"

namespace repose::vision {

/// How a film's stored frames are to be shown, according to its metadata. Rows stay as the camera
/// read them: if pixels are not square, the width is scaled.
struct ShownFrame {
  double pixel_aspect = 1;  ///< width of a stored pixel over its height
  /// Applied in this order: transpose, swap left and right, swap top and bottom.
  bool is_transposed = false;
  bool is_mirrored = false;
  bool is_upside_down = false;

  /// The width of a stored frame after its pixels are made square.
  int width_of(int stored_width) const;
  /// Turns a frame of square pixels.
  void turn(const cv::Mat& lying, cv::Mat& upright) const;
};

/// From the container, otherwise from the frame itself.
/// @param frame  decoded; nullptr: none yet
/// @throws base::InputError  "what. Fix: ...": frames are to be shown sheared or turned by other
///   than quarter turns, or the pixels' aspect ratio is implausible or differs between container
///   and frames.
ShownFrame shown_frame(const AVStream& stream, const AVFrame* frame);

/// The pictures of a film file in order. The frame rate and the number of frames that a file claims
/// need not be true.
class VideoDecoder {
 public:
  /// @throws base::InputError  "FILE: what. Fix: ...": damaged, of an unknown kind, or without
  ///   moving pictures.
  explicit VideoDecoder(const std::filesystem::path& file);

  /// Of a picture as shown.
  /// @throws base::InputError  as copy_to()
  double claimed_pixels() const;
  std::optional<double> claimed_frames_per_s() const;
  /// 0 if the file does not say.
  std::int64_t claimed_frames() const;

  /// Decodes the next picture. False at the end, or when nothing more can be decoded.
  bool advance();
  /// The picture's time stamp, if the file has one; the origin is arbitrary.
  std::optional<double> time_stamp_s() const;
  /// Unit of the time stamps: milliseconds in MKV, hundredths of a second in GIF.
  double stamp_unit_s() const;
  /// The picture as it is to be shown: upright, with square pixels. Its memory may be reused for
  /// the next.
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
