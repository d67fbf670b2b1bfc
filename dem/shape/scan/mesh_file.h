#pragma once

#include <filesystem>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// The triangles of an STL, OBJ or PLY file as they are, in the file's own unit: nothing is joined,
/// nothing checked but that every coordinate is a number of sensible size.
/// @throws base::InputError  when the file is none of these, or holds no triangles.
Mesh read_mesh_file(const std::filesystem::path& file);

}  // namespace repose::dem
