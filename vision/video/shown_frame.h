#pragma once

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

}  // namespace repose::vision
