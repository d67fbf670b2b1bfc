#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/camera/lens.h"

namespace repose::vision {

/// OpenCV's pixel centres are at integers.
inline constexpr double kPixelCentre = 0.5;

/// Removes a lens's distortion from successive pictures of its size.
class LensCorrection {
 public:
  explicit LensCorrection(const Lens& lens);

  /// `corrected` gets its own memory; areas that the camera did not see repeat its edge.
  void correct(const cv::Mat& picture, cv::Mat& corrected) const;

 private:
  cv::Mat to_x_, to_y_;  ///< empty: nothing is distorted
};

}  // namespace repose::vision
