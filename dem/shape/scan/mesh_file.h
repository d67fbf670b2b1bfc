#pragma once

#include <filesystem>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// The triangles of an STL, OBJ or PLY file, unmodified, in the file's own unit: nothing is welded,
/// and only the size of coordinates is checked.
/// @throws base::InputError  the file is none of these, or holds no triangles.
Mesh read_mesh_file(const std::filesystem::path& file);

}  // namespace repose::dem
