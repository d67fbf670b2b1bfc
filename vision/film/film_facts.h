#pragma once

namespace repose::vision {

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
