#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

namespace repose::vision {

/// The scene without what moves in it.
struct Background {
  cv::Mat bgr;
  double noise = 0;  ///< standard deviation of a grey level from frame to frame
};

/// Of each pixel the difference in the channel that differs most.
cv::Mat greatest_difference(const cv::Mat& a, const cv::Mat& b);

/// Of each byte of pictures of one size, the median.
cv::Mat median_of(std::span<const cv::Mat> frames);

/// The median of frames from all over a film. Where something lay for long at the beginning or at
/// the end (a hand, the grain at rest), whichever of the two has no edge around it.
Background background_of(const std::vector<cv::Mat>& samples);

}  // namespace repose::vision
