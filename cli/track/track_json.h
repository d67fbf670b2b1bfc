#pragma once

#include <string>
#include <vector>

#include "cli/track/track_batch.h"

namespace repose::cli {

/// All that is known of each film, as an array of one object a film.
std::string track_json(const std::vector<TrackedFilm>& films);

/// The table that `repose bench restitution` reads: a row for each first bounce, or for all.
std::string track_csv(const std::vector<TrackedFilm>& films, bool tells_all_bounces);

}  // namespace repose::cli
