#pragma once

#include <vector>

#include "vision/track/plate_grain.h"

namespace repose::vision {

/// What differs from the backdrop left and right of it and reaches down to the plate, the largest
/// first.
/// @param strip  see strip_picture()
std::vector<OnPlate> standing_things(const cv::Mat& strip);

}  // namespace repose::vision
