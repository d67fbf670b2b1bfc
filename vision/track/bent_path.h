#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace repose::vision {

/// A straight line by least squares of the distances from it.
struct PathLine {
  cv::Point2d middle;
  cv::Point2d along;           ///< of length 1, the way that was gone
  double offset_error_px = 0;  ///< standard error across the line, at its middle
  double angle_error_rad = 0;
};

/// Two straight lines after each other: down an incline, out on a flat.
struct BentPath {
  PathLine incline;
  PathLine flat;
  double rms_px = 0;           ///< of the places from their lines
  double left_out = 0;         ///< part of the places that lie on none, as where a grain hops
  double bend_rad = 0;         ///< between the lines, above 0
  double bend_error_rad = 0;   ///< standard error
  cv::Point2d corner;          ///< where the lines meet
  double corner_error_px = 0;  ///< standard error along the flat
};

/// The two lines that fit best; none where fewer than 5 places lie on one of them, or both have one
/// direction.
/// @param path  in its order, without what lies still
std::optional<BentPath> bent_path_through(const std::vector<cv::Point2d>& path);

}  // namespace repose::vision
