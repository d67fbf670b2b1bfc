#pragma once

#include <string>
#include <vector>

#include "cli/common/table.h"
#include "cli/track/track.h"

namespace repose::cli {

/// The films' bounces, rolls or tilts as a table, notes on each film, and the mean of first
/// bounces, rolls or tilts.
std::string track_table(const std::vector<TrackedFilm>& films, vision::Filmed filmed, int columns,
                        bool has_colour);

}  // namespace repose::cli
