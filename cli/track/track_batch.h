#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "cli/track/track_options.h"
#include "vision/track/drop_track.h"
#include "vision/track/roll_track.h"
#include "vision/track/tilt_track.h"

namespace repose::cli {

struct TrackedFilm {
  std::string file;
  std::string error = {};    ///< why it could not be read; empty: its track says
  std::string copy_of = {};  ///< an earlier film of the same bytes; empty: it is no copy
  bool is_internal_error = false;
  Filmed filmed = Filmed::drop;
  vision::DropTrack drop = {};  ///< of what was filmed, without the
  vision::RollTrack roll = {};  ///< strobe picture, which is large
  vision::TiltTrack tilt = {};
  std::string overlay_error = {};  ///< why there is no overlay
};

/// What every track has.
vision::MeasureStatus status_of(const TrackedFilm& film);
const std::string& reason_of(const TrackedFilm& film);
const std::vector<vision::Warning>& warnings_of(const TrackedFilm& film);
const vision::FilmFacts& facts_of(const TrackedFilm& film);
bool has_reading(const TrackedFilm& film);

/// Tracks the plan's films, several at a time; in the plan's order, and the same at any number of
/// threads. Stops in the middle of a film when `is_interrupted`; the result is then worth nothing.
std::vector<TrackedFilm> track_batch(const TrackPlan& plan,
                                     const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
