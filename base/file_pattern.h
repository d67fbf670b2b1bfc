#pragma once

#include <filesystem>
#include <string>

/// Names that stand for several files, as in "drops/*.mp4": * and ? in the last part of the path.
namespace repose::base {

/// Whether the name is a pattern, and not that of a file which has such letters in it.
bool is_pattern(const std::filesystem::path& file);

/// Whether a file's name, without its folder, is one of those that the pattern means. Hidden files
/// are none, unless the pattern begins with a dot too.
bool matches(const std::string& name, const std::filesystem::path& pattern);

}  // namespace repose::base
