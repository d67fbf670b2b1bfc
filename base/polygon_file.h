#pragma once

#include <array>
#include <string_view>
#include <vector>

/// Surfaces and clouds of points in files that name corners and faces.

namespace repose::base {

using Corner = std::array<double, 3>;

/// What a file holds of a surface, or of a cloud of points, which has no faces, in the file's own
/// unit.
struct PolygonSurface {
  std::vector<Corner> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, three or more, all of them there
};

/// Reads the corners and faces of a Wavefront OBJ and passes over all else: materials, textures,
/// normals, groups, curves. What the file refers to is never opened. Faces of fewer than three
/// corners are passed over.
/// Source of the format: Wavefront, Advanced Visualizer Manual, appendix B1 (1995).
/// @throws InputError  what is wrong, and where: "line 3: ...".
PolygonSurface parse_obj(std::string_view bytes);

/// Reads PLY (ascii or binary, of either byte order), and believes nothing that its header promises
/// before the bytes are there. Faces of fewer than three corners are passed over.
/// Source of the format: Turk, The PLY polygon file format (1994).
/// @throws InputError  what is wrong, and where: "line 3: ...", "face 17: ...".
PolygonSurface parse_ply(std::string_view bytes);

}  // namespace repose::base
