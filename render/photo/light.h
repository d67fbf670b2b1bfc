#pragma once

#include <vector>

namespace repose::render {

/// Linear light, red green blue a pixel, rows from the top; 1 is white paper in full light.
struct Light {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
};

}  // namespace repose::render
