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

/// The picture's own memory as OpenCV sees it: no copy, valid while the picture lives unchanged.
inline cv::Mat mat_of(Picture& picture) {
  return cv::Mat(picture.height, picture.width, CV_8UC3, picture.bgr.data());
}

/// For reading only: OpenCV has no matrix of constants.
inline cv::Mat mat_of(const Picture& picture) {
  return cv::Mat(picture.height, picture.width, CV_8UC3,
                 const_cast<std::uint8_t*>(picture.bgr.data()));
}

/// Turned clockwise by a multiple of a right angle [deg].
void turn(const cv::Mat& picture, int clockwise_deg, cv::Mat& turned);

/// Keeps OpenCV to the thread that calls it, from the first call on: pictures and films are worked
/// on side by side, and as many as there are cores gain nothing from threads inside OpenCV. (A film
/// alone would: a drop takes .7 s in place of .6.) While one of those waits it may start on another
/// picture and reseed the generator that GrabCut draws from, and their number cannot be changed
/// while they are used. Hence each way into OpenCV that runs in several threads begins here.
void keep_opencv_to_one_thread();

}  // namespace repose::vision
