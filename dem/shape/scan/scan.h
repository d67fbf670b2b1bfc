#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Unit of a scan's coordinates, which STL, OBJ and PLY do not state.
enum class ScanUnit { millimetre, metre };

/// A closed surface, counter-clockwise seen from outside, without self-intersections.
struct Scan {
  Mesh surface;                      ///< m
  std::vector<std::string> repairs;  ///< what was repaired, a sentence each; empty: nothing
};

/// Limits of what is repaired automatically, as fractions of the whole surface.
inline constexpr double kLargestFilledFraction = 0.01;
inline constexpr double kLargestDroppedFraction = 0.01;
/// Limits of a grain's longest extent, m.
inline constexpr double kSmallestGrain_m = 0.05e-3;
inline constexpr double kLargestGrain_m = 2;

/// Reads an STL, OBJ or PLY file and repairs what can be repaired without guessing: corners
/// separated by rounding, flipped triangles, loose flakes, small holes.
/// @throws base::InputError  all errors in the surface, one line each, with the fix.
Scan read_scan(const std::filesystem::path& file, ScanUnit unit);

/// The same for a given surface; `name` appears in errors.
Scan checked_surface(const Mesh& surface_m, const std::string& name);

}  // namespace repose::dem
