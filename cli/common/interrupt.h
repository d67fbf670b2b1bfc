#pragma once

#include <atomic>

namespace repose::cli {

/// Lets Ctrl-C (or SIGTERM) break off the work at hand in good order, by what this returns becoming
/// true; the second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace repose::cli
