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
  FillOptions fill;        ///< for a scan or sizes; a clump file has its own spheres
  double size_factor = 1;  ///< all lengths are multiplied by it
};

/// Reads the scan or clump file, or takes the sizes, and fills the surface with spheres. Takes
/// seconds, unlike reading a study.
/// @throws base::InputError  all errors in the file or the surface.
ClumpFile build_grain(const GrainSource& source);

/// Multiplies all lengths; relative errors stay.
void scale(ClumpFile& clump, double factor);

}  // namespace repose::dem
