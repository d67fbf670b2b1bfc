#pragma once

#include <opencv2/core.hpp>

#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/drawing/lettering.h"

namespace repose::vision {

/// A white bar of `width` pixels: which line is which heap, the numbers, the verdict, the warnings.
cv::Mat draw_legend(int width, const HeapComparison& comparison,
                    const ComparisonOverlayNotes& notes, const Lettering& lettering);

}  // namespace repose::vision
