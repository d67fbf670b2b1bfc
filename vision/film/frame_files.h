#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace repose::vision {

/// A frame of a film that is a picture of its own.
struct FrameFile {
  std::filesystem::path file;
  std::int64_t place = 0;  ///< in the film, from 0 on; frames that are missing leave a gap
};

/// The frames in a folder, by the numbers in their names: frame_9.png comes before frame_10.png.
/// Hidden files and those that are no pictures by their ending do not count. Where all numbers are
/// a multiple of a step apart, as of every tenth frame, that is one place.
/// @throws base::InputError  "FOLDER: what. Rule: ... Fix: ...": no pictures, names without a
///   number or that differ in more than that, or the same number twice.
std::vector<FrameFile> frame_files(const std::filesystem::path& folder);

}  // namespace repose::vision
