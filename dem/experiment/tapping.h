#pragma once

#include "dem/experiment/experiment_run.h"

namespace repose::dem {

/// Drops all walls and grains together by `height_m` onto a base that does not give, so many times,
/// and lets the grains come to rest after each.
///
/// While they fall together nothing presses; then the walls stand still, and the grains meet them
/// with v = sqrt(2 g h), which is what is simulated. Left out: the vessel's own rebound, and the
/// springs of the contacts that unload during the fall (m g times an overlap, far below m g h).
/// Proved by Tapping.* in tests/dem.
void tap(ExperimentRun& run, int taps, double height_m);

}  // namespace repose::dem
