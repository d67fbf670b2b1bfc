#pragma once

#include <cstddef>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// A closed walk along edges that have only one triangle.
struct Hole {
  std::vector<int> rim;  ///< corners, in the order of a filling triangle
  Vector middle = Vector::Zero();
  double area = 0;  ///< of the fan that fills it
};

/// Holes in a consistently oriented surface, in a fixed order.
std::vector<Hole> find_holes(const Mesh& mesh);

/// Closes a hole with one triangle, or with a fan about the middle of its rim.
void fill_hole(const Hole& hole, Mesh& mesh);

struct Oriented {
  std::size_t turned = 0;    ///< triangles flipped, the minority of their piece
  bool is_two_sided = true;  ///< false for a surface without an inside, such as a Moebius strip
};

/// Makes neighbours traverse their common edge in opposite directions. Edges of more than two
/// triangles do not count as connections.
Oriented orient_consistently(Mesh& mesh);

/// Which connected piece each triangle belongs to; pieces are numbered in file order.
std::vector<int> pieces_of(const Mesh& mesh);

struct SelfCrossing {
  std::size_t triangles = 0;      ///< crossing at least one other
  Vector where = Vector::Zero();  ///< middle of the first of them
};

/// Finds triangles that pass through each other. Triangles that merely touch, within 1e-7 of the
/// bounding box, and neighbours folded flat onto each other do not count.
SelfCrossing find_self_crossing(const Mesh& mesh);

struct Welded {
  Mesh mesh;
  std::size_t collapsed = 0;   ///< degenerate triangles, dropped
  std::size_t duplicates = 0;  ///< repeated triangles, dropped
};

/// Corners closer than this fraction of the bounding box's diagonal are merged.
inline constexpr double kWeldFraction = 1e-5;

/// Merges the corners of touching triangles, at the position of the first one; unused corners are
/// dropped.
Welded weld(const Mesh& mesh);

/// Drops unused corners; the others follow in the order in which triangles use them.
Mesh without_loose_corners(const Mesh& mesh);

}  // namespace repose::dem
