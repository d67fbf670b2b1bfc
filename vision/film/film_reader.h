#pragma once

#include <filesystem>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

/// Films, decoded frame by frame in order, never by seeking.
namespace repose::vision {

struct FilmFrame {
  cv::Mat bgr;        ///< upright; its memory is used again for the next frame
  double time_s = 0;  ///< by the film's own time stamps, from the first frame on
};

/// Reads MP4, MOV, AVI, MKV, WebM and GIF.
class FilmReader {
 public:
  /// @throws std::invalid_argument  "FILE: what. Fix: ...": missing, empty, no film, damaged, or of
  /// too many pixels.
  explicit FilmReader(const std::filesystem::path& file);

  /// False at the end, which is where nothing more can be decoded.
  /// @throws std::invalid_argument  a frame has another size than the first.
  bool next(FilmFrame& frame);
  /// As next(), without the picture, which takes the larger part of the time.
  bool skip(FilmFrame& frame);

  /// How many frames the file says it has, which need not be true; 0 where it does not say.
  int claimed_frames() const { return claimed_frames_; }

 private:
  double time_of_frame();

  std::filesystem::path file_;
  cv::VideoCapture film_;
  cv::Size size_;
  int claimed_frames_ = 0;
  double claimed_interval_s_ = 0;
  int frames_ = 0;
  double first_s_ = 0;
  double last_s_ = 0;
};

}  // namespace repose::vision
