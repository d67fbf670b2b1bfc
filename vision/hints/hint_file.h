#pragma once

#include <filesystem>

#include "vision/camera/sized_heap.h"
#include "vision/measure/repose_angle.h"

/// A user's hints for a picture, saved in a small file beside it.

namespace repose::vision {

/// The file with a picture's hints: the picture's name + ".repose.toml".
std::filesystem::path hint_file_of(const std::filesystem::path& picture);

/// Settings for a picture: how its heap is measured, and what gives its scale.
struct PictureSettings {
  MeasureOptions measuring = {};
  ScaleOptions scale = {};
};

/// The settings completed from the file beside the picture: its boxes and places are added to those
/// given; everything else is used only if it was not given. A mask is turned like the picture.
/// @throws base::InputError  "FILE:LINE: what. Rule: ... Fix: ..." for each error of the file.
PictureSettings with_saved_hints(PictureSettings given, const std::filesystem::path& picture);

/// Writes hints, excluded boxes, pitch, scale and lens into the file beside the picture, for the
/// next time; a mask and a lens as file names.
/// @throws base::InputError  the file cannot be written.
void save_hints(const PictureSettings& settings, const std::filesystem::path& picture);

}  // namespace repose::vision
