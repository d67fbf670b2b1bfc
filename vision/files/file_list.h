#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "vision/picture/picture.h"

/// Pictures and films by their names: folders, patterns, copies. Copies of one photograph are one
/// heap, however they are called.

namespace repose::vision {

/// Of pictures that differ in a last number alone, which are of one heap: "heaps/a" for
/// heaps/a_1.jpg and heaps/a-02.png; of a name without _ or - and digits at its end its own,
/// without the ending.
std::string heap_by_name(const std::filesystem::path& picture);

/// A fingerprint of what a picture shows, whatever kind of file it is in.
std::string pixels_of(const Picture& picture);

/// Of each file the place of an earlier one with the same bytes, or whose picture has the same
/// pixels; none: it is the first of its kind, or cannot be read.
/// @param pixels  of each file; empty where they are not known, as of a film
std::vector<std::optional<std::size_t>> copies_among(
    const std::vector<std::filesystem::path>& files, const std::vector<std::string>& pixels);

/// "b.jpg: the same picture as a.jpg, counted once"; of films "the same film"
std::string text_of_copy(const std::filesystem::path& copy, const std::filesystem::path& first);

/// The same for all names of one file, whether it exists or not.
std::filesystem::path identity(const std::filesystem::path& file);

/// By its name.
bool has_picture_ending(const std::filesystem::path& file);

/// NAME.overlay.png beside NAME.vtp: drawn by `repose simulate heap --out` over what it measured.
/// In a folder it stands for no heap.
bool is_overlay_of_state(const std::filesystem::path& file);

/// What names of pictures and films come down to.
struct FileList {
  std::vector<std::filesystem::path> files;
  std::vector<base::Fault> faults;
  std::vector<std::string> notes;  ///< for the user to know, no faults
};

/// Folders become the pictures in them, by the names' endings, without subfolders, and patterns
/// ("heaps/*.jpg") the files that they match; sorted by name. A picture named twice is taken once.
/// Files need not exist: reading them says so.
FileList list_pictures(const std::vector<std::string>& names);
/// The same with films.
FileList list_films(const std::vector<std::string>& names);
/// The same with three-dimensional scans.
FileList list_scans(const std::vector<std::string>& names);
/// The same with pictures and films. Of a folder's films those are left out that a camera took
/// along with a picture of that name: they would count the same heap twice.
FileList list_pictures_and_films(const std::vector<std::string>& names);

/// The same with scans, too. Of a folder's pictures and films those are left out
/// that have a scan's name: its texture, or the same heap once more.
FileList list_heap_files(const std::vector<std::string>& names);

/// The same, but each folder is one film, whose frames are in it.
FileList list_with_frame_folders(const std::vector<std::string>& names);

/// A name without the slashes at its end, which is that of its overlay too.
std::filesystem::path without_slash(const std::string& name);

}  // namespace repose::vision
