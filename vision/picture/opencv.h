#pragma once

#include <cstddef>

#include <opencv2/core/mat.hpp>

#include "vision/picture/picture.h"

namespace repose::vision {

inline Picture blank_picture(int width, int height) {
  const std::size_t bytes =
      std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {.width = width, .height = height, .bgr = std::vector<std::uint8_t>(bytes)};
}

/// OpenCV's view of the picture's own memory: no copy, valid while the picture exists unchanged.
inline cv::Mat mat_of(Picture& picture) {
  return cv::Mat(picture.height, picture.width, CV_8UC3, picture.bgr.data());
}

/// For reading only: OpenCV has no const matrices.
inline cv::Mat mat_of(const Picture& picture) {
  return cv::Mat(picture.height, picture.width, CV_8UC3,
                 const_cast<std::uint8_t*>(picture.bgr.data()));
}

/// Turned clockwise by a multiple of a right angle [deg].
void turn(const cv::Mat& picture, int clockwise_deg, cv::Mat& turned);

/// Limits OpenCV to the calling thread, from the first call on: pictures and films are processed in
/// parallel, and with as many of them as cores, threads inside OpenCV gain nothing. (A single film
/// would gain: a drop takes .7 s instead of .6.) A waiting OpenCV thread may also start on another
/// picture and reseed the generator that GrabCut draws from, and the number of threads cannot be
/// changed while they are in use. Hence every multi-threaded entry point that uses OpenCV begins
/// with this call.
void keep_opencv_to_one_thread();

}  // namespace repose::vision
