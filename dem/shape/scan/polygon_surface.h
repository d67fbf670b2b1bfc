#pragma once

#include <array>
#include <vector>

namespace repose::dem {

/// What a file holds of a surface, in the file's own unit.
struct PolygonSurface {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, three or more, all of them there
};

}  // namespace repose::dem
