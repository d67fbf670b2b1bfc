#pragma once

#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// A closed walk along edges that have one triangle only.
struct Hole {
  std::vector<int> rim;  ///< corners, in the direction in which a filling triangle runs
  Vector middle = Vector::Zero();
  double area = 0;  ///< of the fan that would fill it
};

/// Holes in a consistently oriented surface, in a fixed order.
std::vector<Hole> find_holes(const Mesh& mesh);

/// Closes a hole by one triangle, or by a fan about the middle of its rim.
void fill_hole(const Hole& hole, Mesh& mesh);

}  // namespace repose::dem
