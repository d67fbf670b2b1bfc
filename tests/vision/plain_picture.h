#pragma once

#include <algorithm>
#include <cstdint>

#include "vision/picture/opencv.h"

namespace repose::vision {

/// A picture of uniform grey.
inline Picture plain_picture(int width, int height, std::uint8_t brightness) {
  Picture picture = blank_picture(width, height);
  std::fill(picture.bgr.begin(), picture.bgr.end(), brightness);
  return picture;
}

}  // namespace repose::vision
