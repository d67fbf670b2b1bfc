#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// One side of one triangle: the edge between two corners, low < high.
struct EdgeUse {
  int low = 0;
  int high = 0;
  int triangle = 0;
  int side = 0;            ///< 0, 1, 2: from corner `side` to the next
  bool is_upward = false;  ///< the triangle runs from low to high
};

/// All sides of all triangles, those of the same edge together, in a fixed order.
std::vector<EdgeUse> edge_uses(const Mesh& mesh);

/// Calls visit(std::span<const EdgeUse>) for each edge, with the triangles that meet there.
template <typename Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low &&
           uses[last].high == uses[first].high) {
      ++last;
    }
    visit(uses.subspan(first, last - first));
  }
}

/// Whether every edge belongs to two triangles that run along it in opposite directions.
bool is_watertight(const Mesh& mesh);

}  // namespace repose::dem
