#pragma once

#include <atomic>

namespace repose::cli {

/// From now on Ctrl-C (or SIGTERM, or the end of the terminal) makes what this returns true, for
/// work to stop in good order; the second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace repose::cli
