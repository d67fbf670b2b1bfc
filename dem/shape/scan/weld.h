#pragma once

#include <cstddef>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

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
