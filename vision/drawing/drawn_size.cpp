#include "vision/drawing/drawn_size.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "vision/picture/mat_of_picture.h"

namespace repose::vision {

double drawing_scale(const Picture& picture) {
  constexpr int kSmallestSide = 800;  // px; smaller pictures are enlarged by a whole number
  constexpr int kLargestSide = 2400;  // px; more than a page of a paper can show
  const int longest = std::max(picture.width, picture.height);
  if (longest > kLargestSide) return static_cast<double>(kLargestSide) / longest;
  return longest < kSmallestSide ? (kSmallestSide + longest - 1) / longest : 1;
}

cv::Mat scaled(const Picture& picture, double scale) {
  const cv::Size size(std::max(1, cvRound(picture.width * scale)),
                      std::max(1, cvRound(picture.height * scale)));
  cv::Mat result;
  cv::resize(mat_of(picture), result, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return result;
}

}  // namespace repose::vision
