#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

/// Pictures that repose writes are marked in the software field that viewers show. Others are the
/// user's photographs.
namespace repose::vision {

/// The comment in films that repose writes.
inline constexpr const char* kFilmComment = "Software: repose";

/// Adds the mark to the content of a PNG or JPEG file.
void mark_as_made_here(std::vector<std::uint8_t>& content);

/// Whether a file may be replaced: it has the mark, is empty or does not exist.
bool is_made_here(const std::filesystem::path& file);

}  // namespace repose::vision
