#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vision/camera/sized_heap.h"
#include "vision/track/film_track.h"

/// Tracks a film of a drop, a roll or a tilt, for the command line and the studio.
namespace repose::calibrate {

/// The track without its strobe picture, which is large.
struct TrackedFilm : vision::FilmTrack {
  std::string file;
  std::string error;    ///< why it could not be read; empty: see its track
  std::string copy_of;  ///< an earlier film with the same bytes; empty: not a duplicate
  bool is_internal_error = false;
  std::string overlay_error;  ///< why there is no overlay
};

/// The settings for a film; for folders of frames including their rate.
struct FilmTracking {
  vision::FilmFile film;
  vision::Filmed filmed = vision::Filmed::drop;
  vision::ScaleOptions scale = {};
  std::optional<double> released_mm = {};     ///< for rolls; instead of a scale
  std::function<void(double)> progress = {};  ///< as vision::TrackOptions::progress
  /// Receives the strobe picture with the track drawn in; null: it is not made. An exception from
  /// it becomes the overlay's error.
  std::function<void(const vision::Picture&)> take_overlay = {};
};

/// Tracks it; errors are in the result.
TrackedFilm tracked_film(const FilmTracking& tracking);

/// "drop", "roll" or "tilt".
const char* name_of(vision::Filmed filmed);

/// Everything known about a film.
nlohmann::ordered_json tracked_json(const TrackedFilm& film);

/// The same of each film, as an array.
std::string track_json(const std::vector<TrackedFilm>& films);

/// Which of each film's bounces to output.
enum class BouncesToTell { first, all };

/// The table read by `repose bench restitution` for drops (a row for each first bounce, or for
/// all), by `repose bench rolling` for rolls, and by `repose bench sliding` for tilts.
std::string track_csv(const std::vector<TrackedFilm>& films, vision::Filmed filmed,
                      BouncesToTell bounces);

/// The equivalent `repose track ...` command.
std::string track_command(const FilmTracking& tracking);

}  // namespace repose::calibrate
