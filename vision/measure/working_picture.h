#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/picture/picture.h"

namespace repose::vision {

/// The picture at the size at which heaps are found: at most kWorkingSide pixels a side.
///
/// A flank's angle comes from hundreds of edge points that grains, not pixels, scatter; more pixels
/// cost time and tell nothing more.
struct WorkingPicture {
  cv::Mat3b bgr;
  cv::Mat3f lab;         ///< CIE L*a*b*, L 0 to 100
  cv::Mat1b valid_mask;  ///< 255 where the picture counts: not excluded, no letterbox
  cv::Rect frame;        ///< the picture without its letterbox
  double shrink = 1;     ///< pixels of the picture in a working pixel
};

inline constexpr int kWorkingSide = 800;

WorkingPicture working_picture(const Picture& picture, const std::vector<Box>& excluded);

}  // namespace repose::vision
