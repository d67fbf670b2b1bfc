#include "dem/experiment/tapping.h"

#include <cmath>
#include <cstddef>

#include "dem/experiment/heap_settling.h"

namespace repose::dem {

void tap(ExperimentRun& run, int taps, double height_m) {
  constexpr double kFraction = .35;  // of the run, as the filling before it
  const double speed_m_s = std::sqrt(2 * kStandardGravity_m_s2 * height_m);
  for (int k = 0; k < taps; ++k) {
    Checkpoint now = run.simulation().checkpoint();
    for (std::size_t i = 0; i < now.grains.size(); ++i) {
      if (now.is_present[i]) now.grains[i].velocity.z() -= speed_m_s;
    }
    run.simulation() = Simulation(run.simulation().setup(), now);
    begin_settling(run, HeapStage::settle_in_tube);
    settle(run, kFraction + (1 - kFraction) * (k + 1) / taps);
  }
}

}  // namespace repose::dem
