#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vision/film/film_file.h"

namespace repose::vision {

/// Frames of a film, reduced, for random access.
struct FilmFrames {
  int width = 0;  ///< of the film's own frames
  int height = 0;
  std::vector<double> times_s;  ///< by the film's own time stamps
  std::vector<std::vector<std::uint8_t>> jpegs;
};

struct FilmFramesOptions {
  int side_px = 800;             ///< longest side of a reduced frame, at most
  std::size_t max_frames = 600;  ///< if there are more, every second is kept, or every fourth ...
};

/// @throws base::InputError  "FILE: what. Fix: ...": it is not a readable film.
FilmFrames film_frames(const FilmFile& file, const FilmFramesOptions& options = {});

}  // namespace repose::vision
