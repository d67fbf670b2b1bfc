#pragma once

#include <opencv2/core/mat.hpp>

namespace repose::vision {

/// Whether there are pixels inside the mask and all have one colour, as in a silhouette: then there
/// is no pattern to look for.
inline bool is_flat(const cv::Mat3b& bgr, const cv::Mat1b& mask) {
  const cv::Vec3b* first = nullptr;
  for (int row = 0; row < bgr.rows; ++row) {
    for (int col = 0; col < bgr.cols; ++col) {
      if (mask(row, col) == 0) continue;
      if (first == nullptr) first = &bgr(row, col);
      if (bgr(row, col) != *first) return false;
    }
  }
  return first != nullptr;
}

}  // namespace repose::vision
