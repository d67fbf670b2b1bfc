#pragma once

#include <cstddef>
#include <vector>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

enum class ShapeFormat {
  glb,  ///< binary glTF 2.0, metres, with transparent surface
  stl,  ///< binary STL, millimetres
};

/// The clump's spheres and, if present, its surface, as the content of a file for viewing.
std::vector<std::byte> export_shape(const ClumpShape& shape, ShapeFormat format);

}  // namespace repose::dem
