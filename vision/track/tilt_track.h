#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/picture/picture.h"
#include "vision/track/track.h"

namespace repose::vision {

/// Angle by which the plate has turned in one frame.
struct PlateAngle {
  double time_s = 0;
  double angle_deg = 0;
};

/// Result of a video of a grain on a plate that is tilted. Angles are those by which the plate has
/// turned since the start of the video, when it lies level.
struct TiltTrack {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason = {};  ///< why there is no number
  std::vector<Warning> warnings = {};
  FilmFacts film = {};

  bool has_reading = false;
  Estimate angle_deg = {};   ///< at which the grain begins to slide
  Estimate rate_deg_s = {};  ///< tilting rate, from its beginning to the onset
  double onset_s = 0;
  double begin_deg = 0;   ///< the plate's slope in the picture before it turns
  double turned_deg = 0;  ///< at most
  double noise_deg = 0;   ///< standard deviation of the plate's angle in a frame
  double noise_px = 0;    ///< standard deviation of the grain's place along the plate
  double grain_px = 0;    ///< its length along the plate

  Segment level_edge = {};  ///< the plate's edge, at the start of the video
  Segment onset_edge = {};  ///< the same when the grain begins to slide
  Point onset = {};         ///< the grain's centre at that time
  std::vector<GrainPlace> places = {};
  std::vector<PlateAngle> plate = {};
  Picture strobe = {};  ///< the frame of the onset, if requested
};

/// Follows the plate's upper edge and what stands on it, and traces the slide back to its onset.
/// @throws base::InputError  "FILE: what. Fix: ...": it is not a readable video.
TiltTrack track_tilt(const FilmFile& file, const TrackOptions& options = {});

}  // namespace repose::vision
