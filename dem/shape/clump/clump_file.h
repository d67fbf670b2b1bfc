#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// A clump with where it comes from, as kept in a file.
struct ClumpFile {
  std::string source;                ///< name of the scan, or the calliper sizes
  std::vector<std::string> repairs;  ///< what was mended in the scan
  ClumpShape shape;
  ClumpErrors errors;
};

/// From this volume error on a clump is another shape than its grain. As many spheres as studies
/// have by default miss some per cent.
inline constexpr double kMuchMissed = .25;

/// What whoever uses such a clump must know: a sentence with the remedy. Empty when it misses less.
std::string warning_of_shape(const ClumpFile& clump);

/// As JSON, SI units in the key names; every number comes back to the last bit.
/// @throws base::InputError  a number is not finite: JSON has none of these.
std::string clump_json(const ClumpFile& clump);

/// Reads it back. `name` is what errors call it.
/// @throws base::InputError  all that is wrong, a line each.
ClumpFile parse_clump_json(const std::string& text, const std::string& name);

/// @throws base::InputError  as parse_clump_json, and when the file cannot be read.
ClumpFile read_clump_file(const std::filesystem::path& file);

}  // namespace repose::dem
