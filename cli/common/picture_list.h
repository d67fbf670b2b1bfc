#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/picture/picture.h"

/// Copies of one photograph are one heap, however they are called.

namespace repose::cli {

/// --group-by-name: pictures that differ in a last number alone are of one heap. "heaps/a" for
/// heaps/a_1.jpg and heaps/a-02.png; of a name without _ or - and digits at its end its own,
/// without the ending.
std::string heap_by_name(const std::filesystem::path& picture);

/// A fingerprint of what a picture shows, whatever kind of file it is in.
std::string pixels_of(const vision::Picture& picture);

/// Of each file the place of an earlier one with the same bytes, or whose picture has the same
/// pixels; none: it is the first of its kind, or cannot be read.
/// @param pixels  of each file; empty where they are not known, as of a film
std::vector<std::optional<std::size_t>> copies_among(
    const std::vector<std::filesystem::path>& files, const std::vector<std::string>& pixels);

/// "b.jpg: the same picture as a.jpg, counted once"; of films "the same film"
std::string text_of_copy(const std::filesystem::path& copy, const std::filesystem::path& first);

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
