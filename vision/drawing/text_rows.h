#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/drawing/lettering.h"

namespace repose::vision {

/// A text of a legend; with a heap's line before it where `heap` is 0 or 1.
struct TextRow {
  std::string text;
  cv::Scalar colour;
  int heap = -1;
};

/// A white bar of `width` pixels with the texts below each other, wrapped to it.
cv::Mat draw_text_rows(int width, const std::vector<TextRow>& rows, const Lettering& lettering);

}  // namespace repose::vision
