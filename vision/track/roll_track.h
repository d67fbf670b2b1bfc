#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/track/track.h"

namespace repose::vision {

/// Result of a video of a grain that rolls down an incline and out on a flat. Distances are those
/// of the grain's centre, along the planes, from the foot: the line where they meet.
struct RollTrack {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason = {};  ///< why there is no number
  std::vector<Warning> warnings = {};
  FilmFacts film = {};

  bool has_reading = false;
  Estimate incline_deg = {};      ///< between incline and flat, as seen
  Estimate released_mm = {};      ///< release point, up the incline
  Estimate stopped_mm = {};       ///< rest point, along the flat
  double stopped_s = 0;           ///< when it came to rest
  bool has_scale = false;         ///< false: millimetres come from the release point
  std::vector<Point> board = {};  ///< corners of the board's sheet, if it gives the scale
  double mm_per_px = 0;
  double noise_px = 0;  ///< standard deviation of a centre about the path's two lines
  double grain_px = 0;  ///< diameter of a disc with the grain's area

  Point foot = {};
  Point corner = {};    ///< of the path of the grain's centre
  Point released = {};  ///< the grain's centre
  Point stopped = {};
  std::vector<GrainPlace> places = {};  ///< all of the grain's path
  Picture strobe = {};  ///< the grain at successive times in one picture, if requested
};

/// Follows the grain and fits the two straight lines of its path: incline and flat. The planes lie
/// half the grain's width below them.
/// @param options  with a scale, a board or released_mm, from which the millimetres come
/// @throws base::InputError  "FILE: what. Fix: ...": it is not a readable video.
RollTrack track_roll(const FilmFile& file, const TrackOptions& options);

}  // namespace repose::vision
