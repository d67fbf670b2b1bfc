#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/camera/lens.h"

namespace repose::vision {

/// OpenCV's pixel centres are whole numbers.
inline constexpr double kPixelCentre = 0.5;

/// Takes a lens's distortion out of pictures of its size, one after the other.
class LensCorrection {
 public:
  explicit LensCorrection(const Lens& lens);

  /// `corrected` gets memory of its own; what the camera did not see goes on as its edge.
  void correct(const cv::Mat& picture, cv::Mat& corrected) const;

 private:
  cv::Mat to_x_, to_y_;  ///< empty: nothing is distorted
};

}  // namespace repose::vision
