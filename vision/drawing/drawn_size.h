#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

namespace repose::vision {

inline constexpr int kSmallestCaption = 640;  ///< px wide, beneath narrow pictures

/// How many times larger to draw a picture, so that lines and letters suit it: whole numbers keep
/// the pixels of small pictures square.
double drawing_scale(const Picture& picture);

cv::Mat scaled(const Picture& picture, double scale);

}  // namespace repose::vision
