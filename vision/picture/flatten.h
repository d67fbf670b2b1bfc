#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Makes an 8-bit colour picture of decoded samples: 8 or 16 bits deep; grey, BGR or BGRA with the
/// colours not yet multiplied by alpha.
///
/// - 16 bits: the full range becomes 0 to 255. Cameras store 10 to 14 bits in 16 without
///   stretching them, which would come out almost black; so when nothing in the picture reaches a
///   quarter of the range, its maximum becomes 255.
/// - Transparency: laid over white or black, whichever is farther from the mean brightness of what
///   can be seen, so that the heap stands out from its background.
/// @throws base::InputError  "what. Fix: ..." when it is fully transparent.
Picture flatten(const cv::Mat& decoded);

}  // namespace repose::vision
