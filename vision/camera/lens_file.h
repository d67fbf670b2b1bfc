#pragma once

#include <filesystem>
#include <string>

#include "vision/camera/lens.h"

namespace repose::vision {

/// A camera file: the lens as a small commented TOML.
/// @param origin  what it was fitted to, for the first comment: "10 pictures, ..."
std::string lens_file_text(const Lens& lens, const std::string& origin);

/// @throws base::InputError  "FILE:LINE: what. Rule: ... Fix: ..." for each error in the file.
Lens read_lens_file(const std::filesystem::path& file);

}  // namespace repose::vision
