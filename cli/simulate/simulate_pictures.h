#pragma once

#include <atomic>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// Draws each heap from plan.views sides, equally spaced over half a turn (the other half shows the
/// same, mirrored), and measures the silhouettes as `repose measure` does. Keeps the first view of
/// each repeat, with what was measured drawn in, in the --out folder.
///
/// The runs must be done. The same at any number of threads. Stops between pictures when
/// `is_interrupted`; the pictures are then worth nothing. A machine that cannot draw is no failure
/// of the runs: their pictures say so.
void take_pictures(const SimulatePlan& plan, std::vector<Run>& runs,
                   const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
