#pragma once

#include <numbers>

#include <opencv2/core/mat.hpp>

#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "vision/measure/working_picture.h"
#include "vision/picture/mat_of_picture.h"
#include "vision/picture/picture.h"

/// Pictures that the measuring tests share.
namespace repose::vision {

inline constexpr double kDegree = std::numbers::pi / 180;

inline Picture picture_of(const cv::Mat& bgr) {
  Picture picture = blank_picture(bgr.cols, bgr.rows);
  bgr.copyTo(mat_of(picture));
  return picture;
}

inline WorkingPicture work_of(const cv::Mat& bgr) { return working_picture(picture_of(bgr), {}); }

/// A generated heap at another width, to save time; 800 pixels is the width that is worked at.
inline testing::DrawnHeap drawn(const char* condition, std::uint64_t seed, int width) {
  testing::HeapScene scene = testing::condition_named(condition).scene(seed);
  scene.height = scene.height * width / scene.width;
  scene.width = width;
  return testing::draw_heap(scene);
}

}  // namespace repose::vision
