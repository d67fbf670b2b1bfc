#pragma once

#include <cstddef>
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

struct Oriented {
  std::size_t turned = 0;    ///< triangles that disagreed with most of their neighbours
  bool is_two_sided = true;  ///< false for a surface without an inside, like a Moebius strip
};

/// Makes neighbours run along their common edge in opposite directions. Edges of more than two
/// triangles connect none of them.
Oriented orient_consistently(Mesh& mesh);

/// Which connected piece each triangle belongs to; pieces are numbered in the order of the file.
std::vector<int> pieces_of(const Mesh& mesh);

struct SelfCrossing {
  std::size_t triangles = 0;      ///< that cross at least one other
  Vector where = Vector::Zero();  ///< middle of the first of them
};

/// Looks for triangles that pass through each other. Triangles that only touch, within 1e-7 of the
/// bounding box, and neighbours folded flat on each other do not count.
SelfCrossing find_self_crossing(const Mesh& mesh);

struct Welded {
  Mesh mesh;
  std::size_t collapsed = 0;   ///< triangles that lost a side, dropped
  std::size_t duplicates = 0;  ///< triangles that were there twice, dropped
};

/// Corners closer than this fraction of the bounding box's diagonal are one corner.
inline constexpr double kWeldFraction = 1e-5;

/// Joins the corners of triangles that touch. Corners keep the place of the first one of them;
/// corners of no triangle are dropped.
Welded weld(const Mesh& mesh);

/// Corners of no triangle away, the others in the order in which triangles use them.
Mesh without_loose_corners(const Mesh& mesh);

}  // namespace repose::dem
