#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Names that stand for several files, as in "drops/*.mp4" (* and ? in the last part of the path),
/// and files that are written together into a folder where other files may be too.

namespace repose::base {

/// Whether the name is a pattern, and not that of a file which has such letters in it.
bool is_pattern(const std::filesystem::path& file);

/// Whether a file's name, without its folder, is one of those that the pattern means. Hidden files
/// are none, unless the pattern begins with a dot too.
bool matches(const std::string& name, const std::filesystem::path& pattern);

struct NamedText {
  std::string name;  ///< without folder
  std::string text;
};

/// Owner of an existing file that is not in our manifest.
enum class Unlisted {
  users,  ///< it must not be replaced
  ours,   ///< in a folder that is ours alone: an earlier version wrote it
};

/// Writes each file whole or not at all; makes the folder. FOLDER/.repose-files lists them with
/// their fingerprints: the next time they are replaced, and removed where they are not among the
/// new ones.
/// @throws base::InputError  the folder or a file cannot be written, or files there are not
/// as they were written and would be lost: all of those. Nothing is written then.
void write_file_set(const std::filesystem::path& folder, const std::vector<NamedText>& files,
                    Unlisted unlisted);

/// Finds out before long work whether the folder can be made and written to.
/// @throws base::InputError  it cannot.
void check_file_set(const std::filesystem::path& folder);

}  // namespace repose::base
