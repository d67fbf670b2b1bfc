#pragma once

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Tells when grains have come to rest, by energy and by motion, whatever the time that takes.
///
/// Where no torque resists spin about a contact's normal (all laws of rolling but constant_torque),
/// a grain that touches in one place may spin there for ever. That moves nothing: spin about
/// another axis would roll the grain away or slip, and either shows in its velocity. So the spin of
/// such grains does not count.
///
/// With t the time in which a grain falls by its own reach r from rest, and m its mass: for 2 t on
/// end the mean kinetic energy of the grains must be below 1e-6 m g r, and after that their centres
/// must be within 1e-3 r of where they were (root mean square). A grain that creeps by more than
/// about r / 100 in a second is not at rest.
class RestTest {
 public:
  /// `memory`: of a test that this one goes on from.
  explicit RestTest(const SimulationSetup& setup, RestMemory memory = {});

  /// Looks at the grains now; to be called every few milliseconds.
  bool is_at_rest(const Simulation& simulation);
  /// Time between two looks, s.
  double interval_s() const { return window_s_ / 20; }
  const RestMemory& memory() const { return memory_; }

 private:
  double reach_m_ = 0;
  double gravity_m_s2_ = 0;
  double window_s_ = 0;
  RestMemory memory_;
};

}  // namespace repose::dem
