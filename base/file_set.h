#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Files that are written together into a folder again and again, where other files may be too.
namespace repose::base {

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
