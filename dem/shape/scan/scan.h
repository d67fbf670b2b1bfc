#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// What a scan's coordinates are counted in. STL, OBJ and PLY do not say.
enum class ScanUnit { millimetre, metre };

/// A closed surface, counter-clockwise seen from outside, that does not cross itself.
struct Scan {
  Mesh surface;                      ///< m
  std::vector<std::string> repairs;  ///< what was mended, a sentence each; empty: nothing
};

/// Limits of what is mended without asking, as fractions of the whole surface.
inline constexpr double kLargestFilledFraction = 0.01;
inline constexpr double kLargestDroppedFraction = 0.01;
/// Longest extent of a grain, m.
inline constexpr double kSmallestGrain_m = 0.05e-3;
inline constexpr double kLargestGrain_m = 2;

/// Reads an STL, OBJ or PLY file and mends what can be mended without guessing: corners apart by
/// rounding, triangles turned the wrong way, loose flakes, small holes.
/// @throws base::InputError  all that is wrong with the surface, a line each, with the fix.
Scan read_scan(const std::filesystem::path& file, ScanUnit unit);

/// The same for a surface at hand; `name` is what errors call it.
Scan checked_surface(const Mesh& surface_m, const std::string& name);

}  // namespace repose::dem
