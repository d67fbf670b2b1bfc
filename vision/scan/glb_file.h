#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/polygon_file.h"

namespace repose::vision {

/// Triangles as indexed in a file; without triangles it is a point cloud.
struct TriangleSoup {
  std::vector<base::Corner> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices are valid
};

/// glTF's lengths are metres (glTF 2.0 Specification, sec. 3.4).
inline constexpr double kGlbUnit_mm = 1000;

bool is_glb(std::string_view bytes);

/// The points and triangles of all meshes of a binary glTF file, transformed by its nodes. All
/// counts and offsets in the file are checked before use.
/// @throws base::InputError  what is wrong with it.
TriangleSoup parse_glb(std::string_view bytes);

}  // namespace repose::vision
