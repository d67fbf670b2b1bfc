#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "vision/camera/lens.h"

namespace repose::vision {

/// Location of a film: a file, or a folder that contains its frames as numbered pictures.
struct FilmFile {
  // NOLINTNEXTLINE(google-explicit-constructor): a path alone is a film too
  FilmFile(std::filesystem::path place) : path(std::move(place)) {}
  FilmFile(std::filesystem::path place, std::optional<double> rate,
           const std::optional<Lens>& camera_lens = {}, int clockwise_deg = 0)
      : path(std::move(place)), frames_per_s(rate), lens(camera_lens), turn_deg(clockwise_deg) {}

  std::filesystem::path path;
  /// For a folder of pictures, which do not contain it; film files do.
  std::optional<double> frames_per_s = {};
  /// Its distortion is removed from each frame as it is read.
  std::optional<Lens> lens = {};
  /// Each frame is first turned clockwise by this much; one of kTurns_deg, or 0.
  int turn_deg = 0;
};

/// Properties of a film, independent of its content.
struct FilmFacts {
  int width = 0;
  int height = 0;
  int frames = 0;
  double frames_per_s = 0;
  double length_s = 0;
  int dropped_frames = 0;
};

}  // namespace repose::vision
