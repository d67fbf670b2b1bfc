#pragma once

#include "dem/experiment/experiment_run.h"

namespace repose::dem {

/// For heaps that creep: with the lift, about the 8 s that a bench heap is given before its picture
/// is taken. In the tube it is enough too: the tube holds what creeps.
inline constexpr double kLongestSettling_s = 5;

/// Grains of a heap that are to come to rest, from now on.
void begin_settling(ExperimentRun& run, HeapStage stage);

/// Waits for it, telling `share`; false when they still moved (creep) after 5 s.
bool settle(ExperimentRun& run, double fraction);

}  // namespace repose::dem
