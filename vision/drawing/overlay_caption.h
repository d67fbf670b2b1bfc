#pragma once

#include <opencv2/core.hpp>

#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay.h"

namespace repose::vision {

/// A bar of `width` pixels with the result in words, as high as they need.
cv::Mat draw_caption(int width, const ReposeAngle& measured, const OverlayNotes& notes,
                     const Lettering& lettering);

}  // namespace repose::vision
