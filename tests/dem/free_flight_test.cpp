#include <gtest/gtest.h>

#include "dem/experiment/drop.h"
#include "tests/dem/packing.h"

namespace repose::dem {
namespace {

TEST(FreeFlight, IsWhatStepsWithoutContactsLeadTo) {
  SimulationSetup setup = packing_setup();
  setup.walls.clear();
  setup.timestep_s = 1e-6;
  const Grain start{.position = {.1, .2, .3},
                    .orientation = Quaternion(.5, .1, -.7, .3).normalized(),
                    .velocity = {.2, -.1, 1},
                    .spin = {120, -15, 30}};
  Simulation simulation(setup);
  simulation.add(start);
  simulation.advance(50000);

  const Grain stepped = simulation.grain(0);
  const Grain flown = after_flight(start, setup.kinds[0].shape, setup.gravity, .05);
  EXPECT_LT((flown.position - stepped.position).norm(), 1e-11);
  EXPECT_LT((flown.velocity - stepped.velocity).norm(), 1e-11);
  EXPECT_LT(flown.orientation.angularDistance(stepped.orientation), 1e-5);
  EXPECT_LT((flown.spin - stepped.spin).norm(), 1e-3);
}

}  // namespace
}  // namespace repose::dem
