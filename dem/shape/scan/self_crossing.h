#pragma once

#include <cstddef>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

struct SelfCrossing {
  std::size_t triangles = 0;      ///< that cross at least one other
  Vector where = Vector::Zero();  ///< middle of the first of them
};

/// Looks for triangles that pass through each other. Triangles that only touch, within 1e-7 of the
/// bounding box, and neighbours folded flat on each other do not count.
SelfCrossing find_self_crossing(const Mesh& mesh);

}  // namespace repose::dem
