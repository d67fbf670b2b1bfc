#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/picture/picture.h"

namespace repose::vision {

/// A place where a slope was measured.
struct Slope {
  std::string name;
  std::optional<double> angle_rad;  ///< std::nullopt: no slope found
  Segment line;                     ///< fitted to it [px of the picture]
};

/// The picture with the lines of its slopes and their angles drawn into it.
/// @param title  caption of the picture
/// @throws base::InputError  the picture has no pixels.
Picture draw_slopes_overlay(const Picture& picture, const std::vector<Slope>& slopes,
                            const std::string& title);

}  // namespace repose::vision
