#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/picture/picture.h"
#include "vision/track/track.h"

namespace repose::vision {

/// How far the plate has turned in one frame.
struct PlateAngle {
  double time_s = 0;
  double angle_deg = 0;
};

/// What a film of a grain on a plate that is tilted tells. Angles are those that the plate has
/// turned since the film began, when it lies level.
struct TiltTrack {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason = {};  ///< why there is no number
  std::vector<Warning> warnings = {};
  FilmFacts film = {};

  bool has_reading = false;
  Estimate angle_deg = {};   ///< at which the grain begins to slide
  Estimate rate_deg_s = {};  ///< of the tilting, from its beginning to the onset
  double onset_s = 0;
  double begin_deg = 0;   ///< the plate's lean in the picture before it turns
  double turned_deg = 0;  ///< at most
  double noise_deg = 0;   ///< standard deviation of the plate's angle in a frame
  double noise_px = 0;    ///< standard deviation of the grain's place along the plate
  double grain_px = 0;    ///< its length along the plate

  Segment level_edge = {};  ///< the plate's, where the film begins
  Segment onset_edge = {};  ///< and when the grain begins to slide
  Point onset = {};         ///< the grain's centre then
  std::vector<GrainPlace> places = {};
  std::vector<PlateAngle> plate = {};
  Picture strobe = {};  ///< the frame of the onset, when it was asked for
};

/// Follows the plate's upper edge and what stands on it, and traces the slide back to its onset.
/// @throws base::InputError  "FILE: what. Fix: ...": it is no film that can be read.
TiltTrack track_tilt(const FilmFile& file, const TrackOptions& options = {});

}  // namespace repose::vision
