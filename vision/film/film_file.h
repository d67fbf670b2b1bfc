#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "vision/camera/lens.h"

namespace repose::vision {

/// Where a film is: a file, or a folder that holds its frames as numbered pictures.
struct FilmFile {
  // NOLINTNEXTLINE(google-explicit-constructor): a place alone is a film too
  FilmFile(std::filesystem::path place) : path(std::move(place)) {}
  FilmFile(std::filesystem::path place, std::optional<double> rate,
           const std::optional<Lens>& camera_lens = {}, int clockwise_deg = 0)
      : path(std::move(place)), frames_per_s(rate), lens(camera_lens), turn_deg(clockwise_deg) {}

  std::filesystem::path path;
  /// Of a folder's pictures, which do not say it; files say it themselves.
  std::optional<double> frames_per_s = {};
  /// Whose distortion is taken out of each frame as it is read.
  std::optional<Lens> lens = {};
  /// By how much each frame is turned as it is read, before that; of kTurns_deg, or 0.
  int turn_deg = 0;
};

/// What a film is, whatever it shows.
struct FilmFacts {
  int width = 0;
  int height = 0;
  int frames = 0;
  double frames_per_s = 0;
  double length_s = 0;
  int dropped_frames = 0;
};

}  // namespace repose::vision
