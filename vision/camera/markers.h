#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/camera/board.h"

namespace repose::vision {

/// The cells of a marker, white is 255, including its border of one black cell.
cv::Mat1b marker_cells(int id);

/// The board's corners detected in a grey picture. Unlike everything else, OpenCV counts them from
/// the outer corner of the top left pixel, as vision/picture/picture.h does.
std::vector<SeenCorner> detected_corners(const cv::Mat1b& grey);

}  // namespace repose::vision
