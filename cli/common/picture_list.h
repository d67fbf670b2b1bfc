#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/files/file_list.h"

/// Pictures and films as named on the command line, and the names of their overlays.

namespace repose::cli {

/// The files; adds errors and notes about their names.
std::vector<std::filesystem::path> files_in(vision::FileList list, std::vector<std::string>& errors,
                                            std::vector<std::string>& notes);

/// Reads --fps, the frame rate of folders of numbered frames, which are treated as films. Adds an
/// error if none of the names is a folder.
std::optional<double> read_frame_rate(const std::string& text,
                                      const std::vector<std::string>& names,
                                      std::vector<std::string>& errors);

/// The overlay file of each picture.
struct OverlayFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;
};

/// FOLDER/NAME.png; a number is added for pictures of the same name, and for names that would
/// overwrite an input picture or one that repose did not make.
OverlayFiles name_overlays(const std::vector<std::filesystem::path>& pictures,
                           const std::filesystem::path& folder);

}  // namespace repose::cli
