#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/polygon_file.h"

/// Three-dimensional scans of heaps, as saved by phones and depth cameras.

namespace repose::vision {

inline constexpr std::array<std::string_view, 4> kScanEndings{".ply", ".obj", ".stl", ".glb"};

struct Scan {
  std::vector<base::Corner> points;  ///< in the file's unit; for a surface, spread evenly over it
  std::size_t not_finite = 0;        ///< points left out: not numbers, or beyond 1e9
  bool is_surface = false;
  std::optional<double> unit_mm;  ///< for formats with a fixed unit: GLB, metres
};

/// Judged by the name: .ply, .obj, .stl or .glb.
bool has_scan_ending(const std::filesystem::path& file);

/// Reads PLY, OBJ, STL (both kinds) or binary glTF. Point clouds are returned unchanged. Surfaces,
/// whose vertices may be far apart where they are flat, are sampled with points spread over their
/// triangles. Sources of the formats: base/polygon_file.h; 3D Systems, StereoLithography Interface
/// Specification (1989); Khronos Group, glTF 2.0 Specification (2021), sec. 3.6, 3.7 and 4.
/// Proved by ScanFile.* in tests/vision/scan_file_test.cpp.
/// @throws base::InputError  "FILE: what. Fix: ..." if it cannot be read, holds no points, or
///   more than 40 million.
Scan read_scan(const std::filesystem::path& file);

}  // namespace repose::vision
