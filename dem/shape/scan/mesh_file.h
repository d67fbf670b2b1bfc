#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// What a file holds of a surface, in the file's own unit.
struct PolygonSurface {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, three or more, all of them there
};

/// Reads the corners and faces of a Wavefront OBJ and passes over all else: materials, textures,
/// normals, groups, curves. What the file refers to is never opened. Faces of fewer than three
/// corners are passed over.
/// Source of the format: Wavefront, Advanced Visualizer Manual, appendix B1 (1995).
/// @throws base::InputError  what is wrong, and where: "line 3: ...".
PolygonSurface parse_obj(std::string_view bytes);

/// The triangles of an STL, OBJ or PLY file as they are, in the file's own unit: nothing is joined,
/// nothing checked but that every coordinate is a number of sensible size.
/// @throws base::InputError  when the file is none of these, or holds no triangles.
Mesh read_mesh_file(const std::filesystem::path& file);

}  // namespace repose::dem
