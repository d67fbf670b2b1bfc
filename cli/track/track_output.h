#pragma once

#include <string>
#include <vector>

#include "cli/track/track.h"

namespace repose::cli {

/// All that is known of each film, as an array of one object a film.
std::string track_json(const std::vector<TrackedFilm>& films);

/// The table that `repose bench restitution` reads, of drops: a row for each first bounce, or for
/// all; `repose bench rolling`, of rolls; `repose bench sliding`, of tilts.
std::string track_csv(const std::vector<TrackedFilm>& films, const TrackPlan& plan);

}  // namespace repose::cli
