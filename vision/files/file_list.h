#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "vision/picture/picture.h"

/// Pictures and films by their names: folders, patterns, copies. Copies of one photograph are one
/// heap, whatever their names.

namespace repose::vision {

/// The heap's name, common to pictures of one heap whose names differ only in a final number:
/// "heaps/a" for heaps/a_1.jpg and heaps/a-02.png. A name that does not end in _ or - and digits is
/// kept, without the ending.
std::string heap_by_name(const std::filesystem::path& picture);

/// A fingerprint of a picture's pixels, independent of the file format.
std::string pixels_of(const Picture& picture);

/// For each file the index of an earlier one with the same bytes or pixels; std::nullopt if it is
/// the first, or cannot be read.
/// @param pixels  of each file; empty if unknown, as for a film
std::vector<std::optional<std::size_t>> copies_among(
    const std::vector<std::filesystem::path>& files, const std::vector<std::string>& pixels);

/// "b.jpg: the same picture as a.jpg, counted once"; for films "the same film"
std::string text_of_copy(const std::filesystem::path& copy, const std::filesystem::path& first);

/// A path that is the same for all names of one file, whether it exists or not.
std::filesystem::path identity(const std::filesystem::path& file);

/// Judged by its name.
bool has_picture_ending(const std::filesystem::path& file);

/// NAME.overlay.png beside NAME.vtp: the overlay written by `repose simulate heap --out`. In a
/// folder it does not count as a heap.
bool is_overlay_of_state(const std::filesystem::path& file);

/// The files that a list of names refers to.
struct FileList {
  std::vector<std::filesystem::path> files;
  std::vector<base::Fault> faults;
  std::vector<std::string> notes;  ///< for information, not errors
};

/// Folders are replaced by the pictures in them (by ending, without subfolders), and patterns
/// ("heaps/*.jpg") by the files that they match; sorted by name. A picture named twice is used
/// once. Files need not exist: reading them reports it.
FileList list_pictures(const std::vector<std::string>& names);
/// The same with films.
FileList list_films(const std::vector<std::string>& names);
/// The same with three-dimensional scans.
FileList list_scans(const std::vector<std::string>& names);
/// The same with pictures and films. A folder's films that share a picture's name are left out:
/// cameras save both at once, and the same heap would count twice.
FileList list_pictures_and_films(const std::vector<std::string>& names);

/// The same with scans too. A folder's pictures and films that share a scan's name are left out:
/// they are its texture, or the same heap again.
FileList list_heap_files(const std::vector<std::string>& names);

/// The same, but each folder is one film that consists of the frames in it.
FileList list_with_frame_folders(const std::vector<std::string>& names);

/// A name without trailing slashes, as used for its overlay's name.
std::filesystem::path without_slash(const std::string& name);

}  // namespace repose::vision
