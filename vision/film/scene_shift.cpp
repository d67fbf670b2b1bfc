#include "vision/film/scene_shift.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr int kShiftWidth_px = 240;
/// Grey levels by which what stands before the scene differs from it.
constexpr double kOtherThing = 20;

cv::Mat shift_picture(const cv::Mat& frame) {
  const double scale = std::min(1.0, kShiftWidth_px / static_cast<double>(frame.cols));
  cv::Mat small, grey;
  cv::resize(frame, small, {}, scale, scale, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, grey, {5, 5}, 1);
  return grey;
}

cv::Mat moved_back(const cv::Mat& seen, const cv::Point2d& shift) {
  const cv::Matx23d back(1, 0, shift.x, 0, 1, shift.y);
  cv::Mat moved;
  cv::warpAffine(seen, moved, back, seen.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return moved;
}

}  // namespace

SceneShift::SceneShift(const cv::Mat& scene, const cv::Mat& counts) : grey_(shift_picture(scene)) {
  cv::Sobel(grey_, across_, CV_32F, 1, 0, 3, 1. / 8);
  cv::Sobel(grey_, down_, CV_32F, 0, 1, 3, 1. / 8);
  if (counts.empty()) {
    counts_ = cv::Mat(grey_.size(), CV_8U, cv::Scalar(255));
  } else {
    cv::resize(counts, counts_, grey_.size(), 0, 0, cv::INTER_NEAREST);
  }
}

cv::Point2d SceneShift::of(const cv::Mat& frame) const {
  constexpr double kMost = .5;  // of what differs may be left
  const cv::Mat seen = shift_picture(frame);
  const cv::Point2d shift = shift_of(seen);
  if (difference_to(moved_back(seen, shift)) > kMost * difference_to(seen)) return {0, 0};
  return shift * (static_cast<double>(frame.cols) / seen.cols);
}

cv::Point2d SceneShift::shift_of(const cv::Mat& seen) const {
  constexpr int kRounds = 10;
  constexpr double kEnough_px = .1;
  cv::Mat now = seen;
  cv::Point2d shift;
  for (int round = 0; round < kRounds; ++round) {
    const cv::Point2d step = step_to(now);
    shift += step;
    // Gradients tell a pixel or so at a time.
    if (std::hypot(step.x, step.y) < kEnough_px) break;
    now = moved_back(seen, shift);
  }
  return shift;
}

/// Variance of what differs where nothing stands before the scene.
double SceneShift::difference_to(const cv::Mat& now) const {
  cv::Mat difference = now - grey_;
  const cv::Mat counts = counts_ & (cv::abs(difference) <= kOtherThing);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation, counts);
  return deviation[0] * deviation[0];
}

cv::Point2d SceneShift::step_to(const cv::Mat& now) const {
  // now = gain scene + offset - shift . gradient, where nothing stands before the scene.
  cv::Matx44d normal = cv::Matx44d::zeros();
  cv::Vec4d right(0, 0, 0, 0);
  for (int row = 0; row < now.rows; ++row) {
    for (int k = 0; k < now.cols; ++k) {
      if (counts_.at<uchar>(row, k) == 0) continue;
      const double scene = grey_.at<float>(row, k);
      const double difference = now.at<float>(row, k) - scene;
      if (std::abs(difference) > kOtherThing) continue;
      const cv::Vec4d terms(-across_.at<float>(row, k), -down_.at<float>(row, k), scene / 128, 1);
      normal += terms * terms.t();
      right += difference * terms;
    }
  }
  constexpr double kLeastGradient = 50;  // of a scene with anything to hold on to
  if (normal(0, 0) < kLeastGradient || normal(1, 1) < kLeastGradient) return {0, 0};
  for (int k = 0; k < 4; ++k) normal(k, k) += 1e-6;
  const cv::Vec4d solution = normal.solve(right, cv::DECOMP_CHOLESKY);
  return {solution[0], solution[1]};
}

}  // namespace repose::vision
