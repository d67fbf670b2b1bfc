#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace repose::dem {

/// What a PLY file holds of a surface, in the file's own unit.
struct PlySurface {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, three or more, all of them there
};

/// Reads PLY (ascii or binary, of either byte order), and believes nothing that its header promises
/// before the bytes are there. Faces of fewer than three corners are passed over.
/// Source of the format: Turk, The PLY polygon file format (1994).
/// @throws std::invalid_argument  what is wrong, and where: "line 3: ...", "face 17: ...".
PlySurface parse_ply(std::string_view bytes);

}  // namespace repose::dem
