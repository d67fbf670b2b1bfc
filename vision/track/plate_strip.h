#pragma once

#include <opencv2/core.hpp>

#include "vision/track/plate_motion.h"

namespace repose::vision {

/// What stands above the plate's edge, turned so that the plate lies still: along the plate from
/// left to right, its last row just above the edge.
struct PlateStrip {
  double from_px = 0;  ///< of its first column along the plate, from the origin beside the hinge
  cv::Size size;
};

/// How far along the plate from the origin the edge is in a column of the first frame.
double along_plate(const PlateMotion& motion, int column);

PlateStrip strip_above(const PlateMotion& motion, const cv::Size& frame);

/// @param frame  reduced as the motion is
cv::Mat strip_picture(const cv::Mat& frame, const PlateMotion& motion, const EdgeLine& line,
                      const PlateStrip& strip);

/// Where a place of the strip is in the frame.
cv::Point2d in_frame(const cv::Point2d& place, const PlateMotion& motion, const EdgeLine& line,
                     const PlateStrip& strip);

}  // namespace repose::vision
