#pragma once

#include <array>
#include <string_view>
#include <vector>

/// Surfaces and point clouds from files of vertices and faces.

namespace repose::base {

using Corner = std::array<double, 3>;

/// A file's surface, or point cloud if there are no faces, in the file's own unit.
struct PolygonSurface {
  std::vector<Corner> corners;
  std::vector<std::vector<int>> faces;  ///< vertex indices of each, three or more, all valid
};

/// Reads the vertices and faces of a Wavefront OBJ and skips everything else: materials, textures,
/// normals, groups, curves. Referenced files are never opened. Faces with fewer than three vertices
/// are skipped. Source of the format: Wavefront, Advanced Visualizer Manual, appendix B1 (1995).
/// @throws InputError  what is wrong, and where: "line 3: ...".
PolygonSurface parse_obj(std::string_view bytes);

/// Reads PLY (ascii or binary, either byte order). The header's counts are not trusted: nothing is
/// allocated in advance. Faces with fewer than three vertices are skipped. Source of the format:
/// Turk, The PLY polygon file format (1994).
/// @throws InputError  what is wrong, and where: "line 3: ...", "face 17: ...".
PolygonSurface parse_ply(std::string_view bytes);

}  // namespace repose::base
