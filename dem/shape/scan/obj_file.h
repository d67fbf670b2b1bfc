#pragma once

#include <string_view>

#include "dem/shape/scan/polygon_surface.h"

namespace repose::dem {

/// Reads the corners and faces of a Wavefront OBJ and passes over all else: materials, textures,
/// normals, groups, curves. What the file refers to is never opened. Faces of fewer than three
/// corners are passed over.
/// Source of the format: Wavefront, Advanced Visualizer Manual, appendix B1 (1995).
/// @throws base::InputError  what is wrong, and where: "line 3: ...".
PolygonSurface parse_obj(std::string_view bytes);

}  // namespace repose::dem
