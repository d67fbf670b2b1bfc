#pragma once

#include <vector>

#include "vision/track/drop_candidate.h"
#include "vision/track/film_grains.h"

/// When the frames of a film of a drop were taken, which its flights show: they are parabolas.
namespace repose::vision {

/// A film with the paths in it that may be those of a dropped grain, the best first.
struct TimedDrop {
  /// Its frames' times are those that the flights are parabolas by: of the time stamps, unless
  /// others fit much better.
  FilmGrains film;
  std::vector<DropCandidate> candidates = {};  ///< their paths are the film's
  bool has_own_times = false;  ///< other times than the stamps are used: of a pattern, or even ones
  int skipped_frames = 0;      ///< left out between even time stamps, whose time was put in again
  /// How many times faster some flights are seen to fall than others; none: all fall alike.
  std::optional<double> speed_change = {};
};

TimedDrop timed_drop(FilmGrains film);

/// Times of a film's frames in which a path that goes on evenly before and after a step that is two
/// or more times as long has the time of the frames that are left out there.
struct SkippedFrames {
  std::vector<double> times_s;
  int count = 0;  ///< 0: there are none
};
SkippedFrames skipped_frames(const FilmGrains& film, const GrainPath& path);

}  // namespace repose::vision
