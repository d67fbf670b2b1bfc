#include "dem/engine/unstable_run.h"
#include "dem/state/state_file.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

/// Also goes on with it: one step.
void read_state(Bytes bytes) {
  dem::SavedState state = dem::read_state(scratch_file("state.vtp", bytes));
  try {
    dem::Simulation simulation(std::move(state.setup), state.checkpoint);
    simulation.advance(1);
  } catch (const dem::UnstableRun&) {
    return;  // found out as it should be
  }
}

}  // namespace repose::fuzz
