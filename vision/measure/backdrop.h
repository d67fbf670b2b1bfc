#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/measure/working_picture.h"

namespace repose::vision {

/// What is taken for backdrop until proven otherwise: the upper part of the frame, or the corners
/// of a box around the heap, and what a person has said. 255 there.
cv::Mat1b backdrop_strip(const WorkingPicture& work);

/// ln(1 + how many standard deviations a pixel's colour is from the backdrop's), which is modelled
/// as a smooth surface: it starts from the strip and takes in all pixels that agree with it, so
/// that a gradient across the picture is no obstacle.
cv::Mat1f backdrop_distance(const WorkingPicture& work);

}  // namespace repose::vision
