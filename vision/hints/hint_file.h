#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vision/measure/repose_angle.h"

/// What a person has said of a picture, kept in a small file beside it.
namespace repose::vision {

/// The file in which the hints of a picture are kept: its name with ".repose.toml" behind.
std::filesystem::path hint_file_of(const std::filesystem::path& picture);

/// The options with what the file beside the picture says: boxes and places are added to those of
/// the options, all else is taken where the options say nothing. Unchanged when there is no file.
/// @throws std::invalid_argument  "FILE:LINE: what. Rule: ... Fix: ..." for each error of the file.
MeasureOptions with_saved_hints(MeasureOptions options, const std::filesystem::path& picture);

/// Writes the hints, excluded boxes and pitch of the options into the file beside the picture, for
/// the next time. Of a mask the name of its file.
/// @throws std::invalid_argument  when the file cannot be written.
void save_hints(const MeasureOptions& options, const std::filesystem::path& picture);

}  // namespace repose::vision
