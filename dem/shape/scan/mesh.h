#pragma once

#include <array>
#include <vector>

#include "dem/vector.h"

namespace repose::dem {

/// A surface of triangles, counter-clockwise seen from outside. Metres.
struct Mesh {
  std::vector<Vector> vertices;
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace repose::dem
