#pragma once

#include "dem/experiment/experiment_run.h"

namespace repose::dem {

/// Grains of a heap that are to come to rest, from now on.
void begin_settling(ExperimentRun& run, HeapStage stage);

/// Waits for it, telling `share`; false when they still moved (creep) after 5 s.
bool settle(ExperimentRun& run, double fraction);

}  // namespace repose::dem
