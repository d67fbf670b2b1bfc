#pragma once

#include <filesystem>

#include "vision/camera/sized_heap.h"
#include "vision/measure/repose_angle.h"

/// What a person has said of a picture, kept in a small file beside it.

namespace repose::vision {

/// The file in which the hints of a picture are kept: its name with ".repose.toml" behind.
std::filesystem::path hint_file_of(const std::filesystem::path& picture);

/// What is said of a picture: how its heap is measured, and what gives it millimetres.
struct PictureSettings {
  MeasureOptions measuring = {};
  ScaleOptions scale = {};
};

/// The settings with what the file beside the picture says: boxes and places are added to those
/// given, all else is taken where nothing was given. A mask is turned as the picture is to be.
/// @throws base::InputError  "FILE:LINE: what. Rule: ... Fix: ..." for each error of the file.
PictureSettings with_saved_hints(PictureSettings given, const std::filesystem::path& picture);

/// Writes hints, excluded boxes, pitch, scale and lens into the file beside the picture, for the
/// next time. Of a mask and a lens the name of the file.
/// @throws base::InputError  when the file cannot be written.
void save_hints(const PictureSettings& settings, const std::filesystem::path& picture);

}  // namespace repose::vision
