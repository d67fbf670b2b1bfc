#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

/// Pictures that repose writes say so, where viewers show it as the software they are made with.
/// Others are somebody's photographs.
namespace repose::vision {

/// The comment in films of ours.
inline constexpr const char* kFilmComment = "Software: repose";

/// Adds the mark to the content of a PNG or JPEG file.
void mark_as_made_here(std::vector<std::uint8_t>& content);

/// Whether a file has the mark, or there is none to be lost.
bool is_made_here(const std::filesystem::path& file);

}  // namespace repose::vision
