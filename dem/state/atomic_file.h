#pragma once

#include <filesystem>
#include <string_view>

namespace repose::dem {

/// Writes a file whole or not at all: beside its place, then renamed, so that a full disk or a kill
/// leaves the earlier file as it was.
/// @throws std::invalid_argument  "FILE: what. Fix: ..." when the place cannot be written.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace repose::dem
