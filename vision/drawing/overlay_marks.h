#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Draws silhouette, ground line, fitted lines and angles into `image`, which is the measured
/// picture enlarged `scale` times.
void draw_marks(cv::Mat& image, double scale, const ReposeAngle& measured,
                const OverlayNotes& notes, const Lettering& lettering);

}  // namespace repose::vision
