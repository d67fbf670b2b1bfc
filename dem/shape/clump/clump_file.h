#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// A clump and its origin, as stored in a file.
struct ClumpFile {
  std::string source;                ///< name of the scan, or the calliper sizes
  std::vector<std::string> repairs;  ///< what was repaired in the scan
  ClumpShape shape;
  ClumpErrors errors;
};

/// From this volume error on, a clump no longer represents its grain's shape. The default number of
/// spheres gives a few per cent.
inline constexpr double kMuchMissed = .25;

/// Warning about such a clump: a sentence with the remedy. Empty if the error is smaller.
std::string warning_of_shape(const ClumpFile& clump);

/// As JSON, SI units in the key names; numbers are preserved to the last bit.
/// @throws base::InputError  a number is not finite, which JSON cannot represent.
std::string clump_json(const ClumpFile& clump);

/// Reads it back. `name` appears in errors.
/// @throws base::InputError  all errors, one line each.
ClumpFile parse_clump_json(const std::string& text, const std::string& name);

/// @throws base::InputError  as parse_clump_json, or if the file cannot be read.
ClumpFile read_clump_file(const std::filesystem::path& file);

}  // namespace repose::dem
