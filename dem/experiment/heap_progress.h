#pragma once

#include <cstdint>
#include <vector>

#include "dem/engine/simulation.h"
#include "dem/vector.h"

namespace repose::dem {

/// What a run has cost so far.
struct Work {
  std::int64_t steps = 0;
  double clump_steps = 0;
  double shortest_timestep_s = 1e300;  ///< as long as there are no steps
};

/// What a rest test remembers from one look to the next.
struct RestMemory {
  double since_s = 0;          ///< when the window at hand began
  std::vector<Vector> before;  ///< the centres then; empty before the first look
};

/// What goes on in a heap experiment, in this order.
enum class HeapStage { rain, settle_in_tube, lift, settle };

/// Where a heap experiment stands: with the state of its simulation all that it needs to go on.
struct HeapProgress {
  HeapStage stage = HeapStage::rain;
  Work work = {};
  std::int64_t steps_left = 0;     ///< of the stretch between two looks that is under way
  std::uint64_t random_draws = 0;  ///< taken so far by the rain
  RestMemory rest = {};            ///< of the settling under way
  double until_s = 0;              ///< when that settling ends at the latest
  int grains = 0;                  ///< when the lift began
  double start_m = 0;              ///< how high they lay then
};

/// A heap experiment interrupted on its way.
struct HeapRestart {
  SimulationSetup setup;
  Checkpoint checkpoint;
  HeapProgress progress;
};

}  // namespace repose::dem
