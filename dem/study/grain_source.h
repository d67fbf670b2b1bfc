#pragma once

#include <filesystem>
#include <optional>

#include "dem/shape/clump/clump_file.h"
#include "dem/shape/clump/fill.h"
#include "dem/shape/scan/calliper.h"
#include "dem/shape/scan/scan.h"

namespace repose::dem {

/// Where a study's grain comes from: exactly one of a scan, calliper sizes and a clump file.
struct GrainSource {
  std::optional<std::filesystem::path> scan;
  ScanUnit scan_unit = ScanUnit::millimetre;
  std::optional<CalliperSizes> sizes;
  std::optional<std::filesystem::path> clump;
  FillOptions fill;        ///< of a scan or of sizes; a clump file has its spheres
  double size_factor = 1;  ///< by which all its lengths are multiplied
};

/// Reads the scan, clump file or sizes and fills the surface with spheres: seconds, where reading a
/// study takes none.
/// @throws base::InputError  all that is wrong with the file or the surface.
ClumpFile build_grain(const GrainSource& source);

/// Multiplies all its lengths; errors that are fractions stay.
void scale(ClumpFile& clump, double factor);

}  // namespace repose::dem
