#pragma once

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Detects when grains have come to rest, by energy and by motion, however long that takes.
///
/// If no torque resists spin about a contact's normal (all rolling models except constant_torque),
/// a grain with a single contact may spin there for ever. That moves nothing: spin about another
/// axis would make the grain roll or slip, and either shows in its velocity. So the spin of such
/// grains is ignored.
///
/// With t the time in which a grain falls by its own reach r from rest, and m its mass: for a
/// period of 2 t the mean kinetic energy of the grains must stay below 1e-6 m g r, and at its end
/// their centres must be within 1e-3 r of where they were (root mean square). A grain that creeps
/// by more than about r / 100 in a second is not at rest.
class RestTest {
 public:
  /// `memory`: of a test to resume.
  explicit RestTest(const SimulationSetup& setup, RestMemory memory = {});

  /// Checks the grains now; to be called every interval_s().
  bool is_at_rest(const Simulation& simulation);
  /// Time between two calls, s.
  double interval_s() const { return window_s_ / 20; }
  const RestMemory& memory() const { return memory_; }

 private:
  double reach_m_ = 0;
  double gravity_m_s2_ = 0;
  double window_s_ = 0;
  RestMemory memory_;
};

}  // namespace repose::dem
