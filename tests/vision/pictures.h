#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/working_picture.h"
#include "vision/picture/opencv.h"
#include "vision/picture/picture.h"

/// Pictures that the measuring tests share.
namespace repose::vision {

inline Picture picture_of(const cv::Mat& bgr) {
  Picture picture = blank_picture(bgr.cols, bgr.rows);
  bgr.copyTo(mat_of(picture));
  return picture;
}

inline WorkingPicture work_of(const cv::Mat& bgr) { return working_picture(picture_of(bgr), {}); }

inline ReposeAngle measured_in(const cv::Mat& bgr) { return measure_repose_angle(picture_of(bgr)); }

/// NaN if there is no angle.
inline double deg(std::optional<double> angle_rad) { return angle_rad.value_or(NAN) / kDegree; }

inline constexpr int kUsualWidth = 800;  ///< of drawn heaps: the measurement's working width

/// A drawn heap at another width, to save time.
inline testing::DrawnHeap drawn(const char* condition, std::uint64_t seed, int width) {
  testing::HeapScene scene = testing::condition_named(condition).scene(seed);
  scene.height = scene.height * width / scene.width;
  scene.width = width;
  return testing::draw_heap(scene);
}

/// The region under a drawn heap's exact outline.
inline cv::Mat1b mask_of(const testing::DrawnHeap& heap) {
  std::vector<cv::Point> corners = {
      {static_cast<int>(heap.ground.to.x), static_cast<int>(heap.ground.to.y)},
      {static_cast<int>(heap.ground.from.x), static_cast<int>(heap.ground.from.y)}};
  for (const Point& p : heap.outline) {
    corners.emplace_back(static_cast<int>(p.x), static_cast<int>(p.y));
  }
  cv::Mat1b mask = cv::Mat1b::zeros(heap.picture.height, heap.picture.width);
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, 255);
  return mask;
}

/// Intersection of the two regions / their union.
inline double overlap(const cv::Mat1f& inside, const cv::Mat1b& heap) {
  const cv::Mat1b found = inside > 0;
  return static_cast<double>(cv::countNonZero(found & heap)) / cv::countNonZero(found | heap);
}

}  // namespace repose::vision
