#pragma once

#include <opencv2/core/mat.hpp>

namespace repose::vision {

/// How lightness changes to the next pixel: whether there is a pattern to look for.
struct LightSteps {
  double mean = 0;
  double even = 0;  ///< part of the steps that are none; 0 where there are no pixels

  /// All of one lightness but for gaps between the grains; all else shows grains, whose light and
  /// dark are not smooth.
  bool are_of_silhouette() const { return even > 0.985; }
};

/// @param lightness  L, 0 to 100
LightSteps light_steps(const cv::Mat1f& lightness, const cv::Mat1b& inside);

}  // namespace repose::vision
