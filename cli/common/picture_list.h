#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace repose::cli {

/// The same for all names of one file, whether it exists or not.
std::filesystem::path identity(const std::filesystem::path& file);

/// "FILE: what. Fix: ...": errors of measuring a picture do not name it, those of reading it do.
std::string naming_file(const std::string& file, const std::string& error);

/// By its name.
bool has_picture_ending(const std::filesystem::path& file);

/// NAME.overlay.png beside NAME.vtp: drawn by `repose simulate heap --out` over what it measured.
/// In a folder it stands for no heap.
bool is_overlay_of_state(const std::filesystem::path& file);

/// What names on the command line or in a study come down to.
struct FileList {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> errors;  ///< "NAME: what. Fix: ..."
  std::vector<std::string> notes;   ///< for the user to know, no errors
};

/// Folders become the pictures in them, by the names' endings, without subfolders, and patterns
/// ("heaps/*.jpg") the files that they match; sorted by name. A picture named twice is taken once.
/// Files need not exist: reading them says so.
FileList list_pictures(const std::vector<std::string>& names);
/// The same with films.
FileList list_films(const std::vector<std::string>& names);
/// The same with both. Of a folder's films those are left out that a camera took along with a
/// picture of that name: they would count the same heap twice.
FileList list_pictures_and_films(const std::vector<std::string>& names);

/// The same, but each folder is one film, whose frames are in it.
FileList list_with_frame_folders(const std::vector<std::string>& names);

/// A name without the slashes at its end, which is that of its overlay too.
std::filesystem::path without_slash(const std::string& name);

/// Of --fps, which makes films of folders of numbered frames: how many were taken a second. An
/// error where none of the names is a folder.
std::optional<double> read_frame_rate(const std::string& text,
                                      const std::vector<std::string>& names,
                                      std::vector<std::string>& errors);

/// Where the overlay of each picture goes.
struct OverlayFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;
};

/// FOLDER/NAME.png; pictures of the same name, and names that would overwrite a picture that is
/// read or that repose did not make, get a number.
OverlayFiles name_overlays(const std::vector<std::filesystem::path>& pictures,
                           const std::filesystem::path& folder);

}  // namespace repose::cli
