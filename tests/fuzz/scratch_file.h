#pragma once

#include <filesystem>
#include <string>

#include "tests/fuzz/readers.h"
#include "tests/support/temporary_folder.h"

namespace repose::fuzz {

/// A file with these bytes, for readers that take a name; the next call replaces it.
inline std::filesystem::path scratch_file(const std::string& name, Bytes bytes) {
  static const testing::TemporaryFolder folder;
  return folder.write(name, bytes);
}

inline std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace repose::fuzz
