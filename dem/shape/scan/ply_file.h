#pragma once

#include <string_view>

#include "dem/shape/scan/mesh_file.h"

namespace repose::dem {

/// Reads PLY (ascii or binary, of either byte order), and believes nothing that its header promises
/// before the bytes are there. Faces of fewer than three corners are passed over.
/// Source of the format: Turk, The PLY polygon file format (1994).
/// @throws base::InputError  what is wrong, and where: "line 3: ...", "face 17: ...".
PolygonSurface parse_ply(std::string_view bytes);

}  // namespace repose::dem
