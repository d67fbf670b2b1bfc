#include <cmath>

#include <gtest/gtest.h>

#include "dem/experiment/filling.h"
#include "dem/experiment/heap.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

constexpr HeapProtocol kTubeToTap{
    .tube_diameter_m = .1, .tube_height_m = .1, .plate_m = .12, .grains = {}};
constexpr double kTap_m = .01, kRestitution = .7;

/// A single ball lying in the tube.
ExperimentRun with_a_ball(const Observers& observers) {
  Model model = test::sphere_bench();
  model.grain_wall.restitution = kRestitution;
  HeapProtocol tube = kTubeToTap;
  tube.grains = 1;
  ExperimentRun run = empty_tube(model, tube, observers);
  pour(run, tube, 1);
  return run;
}

TEST(Tapping, ABallRisesByTheSquareOfItsRestitutionOfTheDrop) {
  // sqrt(2 g h) onto the plate, e of it back: e^2 h. A ball lying there at the tap does not meet
  // the plate within a step, where impacts are averaged: e is up to .02 higher (THEORY, Time step).
  double lowest = 1, highest = 0;
  bool is_tapped = false;
  const ProgressReport report;
  RunRecord record;
  record.frame_interval_s = 1e-4;
  record.frame = [&](const Simulation& simulation) {
    if (!is_tapped) return;
    lowest = std::min(lowest, simulation.grain(0).position.z());
    highest = std::max(highest, simulation.grain(0).position.z());
  };
  ExperimentRun run = with_a_ball({report, record});
  const double rest = run.simulation().grain(0).position.z();
  is_tapped = true;
  tap(run, 1, kTap_m);
  EXPECT_NEAR(highest - rest, kRestitution * kRestitution * kTap_m, .03 * kTap_m);
  EXPECT_LT(lowest, rest);
  EXPECT_NEAR(run.simulation().grain(0).position.z(), rest, 1e-5) << "and comes to rest";
}

TEST(Tapping, NoTapLeavesEverythingAsItIs) {
  const ProgressReport report;
  const RunRecord record;
  ExperimentRun run = with_a_ball({report, record});
  const double now_s = run.simulation().time_s();
  tap(run, 0, kTap_m);
  EXPECT_EQ(run.simulation().time_s(), now_s);
}

}  // namespace
}  // namespace repose::dem
