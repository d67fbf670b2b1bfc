#include "vision/picture/opencv.h"

#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>

namespace repose::vision {

void turn(const cv::Mat& picture, int clockwise_deg, cv::Mat& turned) {
  switch (clockwise_deg) {
    case 90:
      return cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
    case 180:
      return cv::rotate(picture, turned, cv::ROTATE_180);
    case 270:
      return cv::rotate(picture, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    default:
      picture.copyTo(turned);
  }
}

void keep_opencv_to_one_thread() {
  static const bool once = [] {
    cv::setNumThreads(1);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace repose::vision
