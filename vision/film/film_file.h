#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace repose::vision {

/// Where a film is: a file, or a folder that holds its frames as numbered pictures.
struct FilmFile {
  // NOLINTNEXTLINE(google-explicit-constructor): a place alone is a film too
  FilmFile(std::filesystem::path place) : path(std::move(place)) {}
  FilmFile(std::filesystem::path place, std::optional<double> rate)
      : path(std::move(place)), frames_per_s(rate) {}

  std::filesystem::path path;
  /// Of a folder's pictures, which do not say it; files say it themselves.
  std::optional<double> frames_per_s = {};
};

}  // namespace repose::vision
