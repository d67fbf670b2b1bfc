#pragma once

#include <filesystem>

#include "vision/video/film_writer.h"

namespace repose::testing {

/// Writes all frames of a drawn drop, roll or tilt as a film.
/// @param plays_at  frames per second; 0: the camera's rate
template <typename Drawn>
void write_film(const std::filesystem::path& file, const Drawn& drawn, double plays_at = 0) {
  vision::FilmWriter film(file, plays_at > 0 ? plays_at : drawn.frames_per_s);
  const auto scene = drawn.scene();
  for (int frame = 0; frame < drawn.frames(); ++frame) film.add(drawn.picture(frame, scene));
  film.close();
}

}  // namespace repose::testing
