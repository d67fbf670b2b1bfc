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

}  // namespace repose::vision
