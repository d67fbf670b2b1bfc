#pragma once

#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/track/drop_track.h"
#include "vision/track/roll_track.h"
#include "vision/track/tilt_track.h"
#include "vision/track/track.h"

/// A video of any of the experiments that can be filmed.

namespace repose::vision {

enum class Filmed { drop, roll, tilt };

struct FilmTrack {
  Filmed filmed = Filmed::drop;
  DropTrack drop = {};  ///< of what was filmed; the others stay empty
  RollTrack roll = {};
  TiltTrack tilt = {};
};

/// @throws base::InputError  as track_drop(), track_roll() and track_tilt().
FilmTrack track_film(Filmed filmed, const FilmFile& film, const TrackOptions& options);

/// Common to all tracks.
MeasureStatus status_of(const FilmTrack& film);
const std::string& reason_of(const FilmTrack& film);
const std::vector<Warning>& warnings_of(const FilmTrack& film);
const FilmFacts& facts_of(const FilmTrack& film);
bool has_reading(const FilmTrack& film);

/// Deletes the strobe picture, which is large.
void drop_strobe(FilmTrack& film);

}  // namespace repose::vision
