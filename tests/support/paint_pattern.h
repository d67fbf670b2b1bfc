#pragma once

#include <opencv2/core/mat.hpp>

#include "tests/support/heap_random.h"

namespace repose::testing {

enum class Pattern { plain, noise, fabric, wood, bricks, tiles, stripes, planks };

/// Change of the light, of order 1; `scale_px` is a thread, a brick's height, half a stripe.
cv::Mat pattern_field(Pattern pattern, cv::Size size, double scale_px, Random& random);

}  // namespace repose::testing
