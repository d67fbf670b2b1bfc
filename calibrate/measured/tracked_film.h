#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vision/camera/sized_heap.h"
#include "vision/track/film_track.h"

/// A film of a drop, a roll or a tilt, tracked: what the command line prints and the studio shows.
namespace repose::calibrate {

/// Its track is without the strobe picture, which is large.
struct TrackedFilm : vision::FilmTrack {
  std::string file;
  std::string error;    ///< why it could not be read; empty: its track says
  std::string copy_of;  ///< an earlier film of the same bytes; empty: it is no copy
  bool is_internal_error = false;
  std::string overlay_error;  ///< why there is no overlay
};

/// What is said of a film, of folders of frames with their rate.
struct FilmTracking {
  vision::FilmFile film;
  vision::Filmed filmed = vision::Filmed::drop;
  vision::ScaleOptions scale = {};
  std::optional<double> released_mm = {};     ///< of rolls; in place of a scale
  std::function<void(double)> progress = {};  ///< as vision::TrackOptions::progress
  /// Is given the strobe picture with what was tracked drawn in; null: it is not made. What it
  /// throws is the overlay's error.
  std::function<void(const vision::Picture&)> take_overlay = {};
};

/// Tracks it; what is wrong with it is in the result.
TrackedFilm tracked_film(const FilmTracking& tracking);

/// "drop", "roll" or "tilt".
const char* name_of(vision::Filmed filmed);

/// All that is known of a film.
nlohmann::ordered_json tracked_json(const TrackedFilm& film);

/// The same of each film, as an array.
std::string track_json(const std::vector<TrackedFilm>& films);

/// Of each film's bounces the first, or all.
enum class BouncesToTell { first, all };

/// The table that `repose bench restitution` reads, of drops: a row for each first bounce, or for
/// all; `repose bench rolling`, of rolls; `repose bench sliding`, of tilts.
std::string track_csv(const std::vector<TrackedFilm>& films, vision::Filmed filmed,
                      BouncesToTell bounces);

/// `repose track ...`, which does the same.
std::string track_command(const FilmTracking& tracking);

}  // namespace repose::calibrate
