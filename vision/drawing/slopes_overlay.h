#pragma once

#include <string>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// A line that was fitted to a slope.
struct Slope {
  std::string name;
  double angle_rad = 0;
  Segment line;  ///< [px of the picture]
};

/// The picture with the lines of its slopes and their angles drawn into it.
/// @param title  what the picture shows
/// @throws std::invalid_argument  the picture has no pixels.
Picture draw_slopes_overlay(const Picture& picture, const std::vector<Slope>& slopes,
                            const std::string& title);

}  // namespace repose::vision
