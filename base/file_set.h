#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Patterns that stand for several files, as in "drops/*.mp4" (* and ? in the last part of the
/// path), and sets of files written together into a folder that may contain other files.

namespace repose::base {

/// Whether the name is a pattern rather than that of an existing file with such characters in it.
bool is_pattern(const std::filesystem::path& file);

/// Whether a file's name, without its folder, matches the pattern. Hidden files match only if the
/// pattern begins with a dot too.
bool matches(const std::string& name, const std::filesystem::path& pattern);

struct NamedText {
  std::string name;  ///< without the folder
  std::string text;
};

/// Owner of an existing file that is not in our manifest.
enum class Unlisted {
  users,  ///< it must not be replaced
  ours,   ///< the folder is ours alone: an earlier version wrote it
};

/// Writes each file atomically; creates the folder. FOLDER/.repose-files lists them with their
/// fingerprints: next time they are replaced, or removed if not among the new ones.
/// @throws base::InputError  the folder or a file cannot be written, or files that are not as we
/// wrote them would be lost; lists all of those. Nothing is written then.
void write_file_set(const std::filesystem::path& folder, const std::vector<NamedText>& files,
                    Unlisted unlisted);

/// Checks before long work whether the folder can be created and written to; creates it.
/// @throws base::InputError  it cannot.
void check_file_set(const std::filesystem::path& folder);

}  // namespace repose::base
