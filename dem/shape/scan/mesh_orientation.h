#pragma once

#include <cstddef>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

struct Oriented {
  std::size_t turned = 0;    ///< triangles that disagreed with most of their neighbours
  bool is_two_sided = true;  ///< false for a surface without an inside, like a Moebius strip
};

/// Makes neighbours run along their common edge in opposite directions. Edges of more than two
/// triangles connect none of them.
Oriented orient_consistently(Mesh& mesh);

/// Which connected piece each triangle belongs to; pieces are numbered in the order of the file.
std::vector<int> pieces_of(const Mesh& mesh);

}  // namespace repose::dem
