#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "cli/track/track_options.h"
#include "vision/track/drop_track.h"

namespace repose::cli {

struct TrackedFilm {
  std::string file;
  std::string error = {};  ///< why it could not be read; empty: `drop` says
  bool is_internal_error = false;
  vision::DropTrack drop = {};     ///< without the strobe picture, which is large
  std::string overlay_error = {};  ///< why there is no overlay
};

/// Tracks the plan's films, several at a time; in the plan's order, and the same at any number of
/// threads. Stops in the middle of a film when `is_interrupted`; the result is then worth nothing.
std::vector<TrackedFilm> track_batch(const TrackPlan& plan,
                                     const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
