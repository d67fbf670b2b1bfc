#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/files/file_list.h"

/// Pictures and films as commands name them, and the names of their overlays.

namespace repose::cli {

/// The files, and what is wrong and to be known of their names.
std::vector<std::filesystem::path> files_in(vision::FileList list, std::vector<std::string>& errors,
                                            std::vector<std::string>& notes);

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
