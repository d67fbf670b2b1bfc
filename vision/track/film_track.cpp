#include "vision/track/film_track.h"

namespace repose::vision {
namespace {

/// Applies `read` to the track of the experiment that was filmed.
template <typename Film, typename Read>
decltype(auto) of_track(Film& film, const Read& read) {
  switch (film.filmed) {
    case Filmed::drop:
      return read(film.drop);
    case Filmed::roll:
      return read(film.roll);
    case Filmed::tilt:
      break;
  }
  return read(film.tilt);
}

}  // namespace

FilmTrack track_film(Filmed filmed, const FilmFile& film, const TrackOptions& options) {
  FilmTrack track{.filmed = filmed};
  switch (filmed) {
    case Filmed::drop:
      track.drop = track_drop(film, options);
      break;
    case Filmed::roll:
      track.roll = track_roll(film, options);
      break;
    case Filmed::tilt:
      track.tilt = track_tilt(film, options);
      break;
  }
  return track;
}

MeasureStatus status_of(const FilmTrack& film) {
  return of_track(film, [](const auto& track) { return track.status; });
}

const std::string& reason_of(const FilmTrack& film) {
  return of_track(film, [](const auto& track) -> const std::string& { return track.reason; });
}

const std::vector<Warning>& warnings_of(const FilmTrack& film) {
  return of_track(film,
                  [](const auto& track) -> const std::vector<Warning>& { return track.warnings; });
}

const FilmFacts& facts_of(const FilmTrack& film) {
  return of_track(film, [](const auto& track) -> const FilmFacts& { return track.film; });
}

bool has_reading(const FilmTrack& film) {
  switch (film.filmed) {
    case Filmed::drop:
      return !film.drop.bounces.empty();
    case Filmed::roll:
      return film.roll.has_reading;
    case Filmed::tilt:
      break;
  }
  return film.tilt.has_reading;
}

void drop_strobe(FilmTrack& film) {
  of_track(film, [](auto& track) { track.strobe = {}; });
}

}  // namespace repose::vision
