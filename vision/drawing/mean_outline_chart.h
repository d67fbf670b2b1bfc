#pragma once

#include <opencv2/core.hpp>

#include "vision/compare/heap_sets.h"
#include "vision/drawing/lettering.h"

namespace repose::vision {

/// The mean outlines of both sets with their bands on a white chart of `width` pixels.
cv::Mat draw_mean_outlines(int width, const SetComparison& comparison, const Lettering& lettering);

}  // namespace repose::vision
