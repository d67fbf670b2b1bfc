#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/picture/picture.h"

/// Copies of one photograph are one heap, however they are called.
namespace repose::cli {

/// A fingerprint of what a picture shows, whatever kind of file it is in.
std::string pixels_of(const vision::Picture& picture);

/// Of each file the place of an earlier one with the same bytes, or whose picture has the same
/// pixels; none: it is the first of its kind, or cannot be read.
/// @param pixels  of each file; empty where they are not known, as of a film
std::vector<std::optional<std::size_t>> copies_among(
    const std::vector<std::filesystem::path>& files, const std::vector<std::string>& pixels);

/// "b.jpg: the same picture as a.jpg, counted once"; of films "the same film"
std::string text_of_copy(const std::filesystem::path& copy, const std::filesystem::path& first);

}  // namespace repose::cli
