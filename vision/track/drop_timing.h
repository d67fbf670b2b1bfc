#pragma once

#include <vector>

#include "vision/track/drop_candidate.h"
#include "vision/track/film_grains.h"

/// When the frames of a video of a drop were taken, inferred from its flights, which are parabolas.
namespace repose::vision {

/// A video with the paths that may belong to a dropped grain, best first.
struct TimedDrop {
  /// Its frame times are those that make the flights parabolas: the time stamps, unless other times
  /// fit much better.
  FilmGrains film;
  std::vector<DropCandidate> candidates = {};  ///< their paths belong to `film`
  bool has_own_times = false;  ///< the time stamps were replaced: by a pattern of repeats, or by
                               ///< even times
  int skipped_frames = 0;      ///< missing between even time stamps; their time was reinserted
  /// How many times faster some flights fall than others; std::nullopt: all fall alike.
  std::optional<double> speed_change = {};
};

TimedDrop timed_drop(FilmGrains film);

/// Frame times with the time of left-out frames reinserted: where a smooth path has a single step
/// that is two or more times as long as its neighbours.
struct SkippedFrames {
  std::vector<double> times_s;
  int count = 0;  ///< 0: none are missing
};
SkippedFrames skipped_frames(const FilmGrains& film, const GrainPath& path);

}  // namespace repose::vision
