#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/camera/board.h"

namespace repose::vision {

/// The cells of a marker, 255 white, with a border of one black cell around them.
cv::Mat1b marker_cells(int id);

/// What the board's detector finds in a grey picture. OpenCV counts the board's corners, unlike all
/// else, from the outer corner of the top left pixel, as vision/picture/picture.h does.
std::vector<SeenCorner> detected_corners(const cv::Mat1b& grey);

}  // namespace repose::vision
