#pragma once

#include <opencv2/core/mat.hpp>

#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"

namespace repose::testing {

/// Smooth random field of mean 0 and standard deviation about 1, with bumps of the given size.
cv::Mat smooth_noise(cv::Size size, double bump_width_px, double bump_height_px, Random& random);

/// Pattern of mean 0 and standard deviation 1; `scale_px` is its finest detail.
cv::Mat texture_field(Texture texture, cv::Size size, double scale_px, Random& random);

}  // namespace repose::testing
