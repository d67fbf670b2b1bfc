#pragma once

#include "cli/calibrate/calibrate_options.h"

namespace repose::cli {

/// Tracks the films that the plan's study names, several at a time: each gives a reading, or it is
/// said why it gives none. An experiment none of whose films gives one is an error.
void read_films(CalibratePlan& plan);

}  // namespace repose::cli
