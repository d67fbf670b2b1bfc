#pragma once

#include <opencv2/core.hpp>

#include "vision/drawing/canvas.h"

/// How the two heaps of a comparison are told apart, in chart and legend: by the line's kind first,
/// so that a black-and-white print will do.
namespace repose::vision {

inline const cv::Scalar kInk{30, 30, 30};
inline const cv::Scalar kFaint{110, 110, 110};

/// The first heap's line is solid and dark, the second one's dashed and lighter.
inline void draw_heap_line(const Canvas& canvas, const Path& path, std::size_t heap) {
  constexpr double kWeight = 1.3;
  constexpr double kDash = 0.02;
  if (heap == 0) {
    canvas.draw(path, kInk, kWeight);
  } else {
    canvas.draw_dashed(path, kVermilion, kWeight, kDash);
  }
}

}  // namespace repose::vision
