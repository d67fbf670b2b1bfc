#pragma once

#include <array>

#include <opencv2/core.hpp>

#include "vision/compare/heap_sets.h"
#include "vision/drawing/lettering.h"

namespace repose::vision {

/// Above an axis of degrees, a row for each set: every heap's angle as a circle, the mean as a bar
/// with its 95 % interval.
cv::Mat draw_angle_strip(int width, const std::array<SetOfHeaps, 2>& sets,
                         const Lettering& lettering);

}  // namespace repose::vision
