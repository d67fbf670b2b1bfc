#pragma once

#include <opencv2/core.hpp>

#include "vision/compare/heap_comparison.h"
#include "vision/drawing/lettering.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// Both outlines, ground line, axis and, where there is a scale, a bar of known length, on the
/// faded first picture.
cv::Mat draw_chart(const Picture& first, const ReposeAngle& first_measured,
                   const HeapComparison& comparison, const Lettering& lettering);

}  // namespace repose::vision
