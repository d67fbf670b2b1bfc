#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/engine/time_step.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/model_setup.h"
#include "dem/verify/scene.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

constexpr double kUsual_m_s = 1.3;

/// A sphere flying over a plane, set up as in bulk experiments.
Simulation flying(const Model& model, double speed_m_s, double spin_rad_s = 0) {
  Simulation simulation(bulk_setup(model, {study_wall(Plane{})}, kUsual_m_s));
  simulation.add(
      {.position = {0, 0, 1}, .velocity = {speed_m_s, 0, 0}, .spin = {0, spin_rad_s, 0}});
  return simulation;
}

double step_at(const Model& model, double speed_m_s, double spin_rad_s = 0, double ahead_s = 0) {
  AdaptiveTimestep pace(model, kUsual_m_s);
  return pace.timestep_s(flying(model, speed_m_s, spin_rad_s), ahead_s);
}

double accurate_at(const Model& model, double speed_m_s) {
  return bulk_setup(model, {study_wall(Plane{})}, speed_m_s).timestep_s;
}

TEST(AdaptiveTimestep, IsWhatTheFastestGrainAllows) {
  const Model model = test::sphere_bench();
  for (double speed = .14; speed < 10; speed *= 1.07) {
    const double allowed = accurate_at(model, speed);
    const double step = step_at(model, speed);
    EXPECT_LE(step, (1 + 1e-9) * allowed) << speed;
    EXPECT_GE(step, .94 * allowed) << speed;  // two rungs, each 1.15^(1/5)
  }
}

TEST(AdaptiveTimestep, GrainsAtRestMoveInStepsOfATenthOfTheUsualSpeed) {
  const Model model = test::sphere_bench();
  const double usual = accurate_at(model, kUsual_m_s);
  EXPECT_NEAR(step_at(model, 0) / usual, std::pow(1.15, 16. / 5), 1e-9);
  EXPECT_EQ(step_at(model, 1e-3), step_at(model, 0));
}

TEST(AdaptiveTimestep, SpinAndTheFallAheadCount) {
  const Model model = test::sphere_bench();
  const double turning = .5 / model.grain.reach_m();
  EXPECT_EQ(step_at(model, 0, turning * .999), step_at(model, .5 * .999));
  EXPECT_EQ(step_at(model, .1, turning * .999), step_at(model, .6 * .999));
  EXPECT_EQ(step_at(model, .2, 0, .03), step_at(model, .2 + .03 * kStandardGravity_m_s2));
}

TEST(AdaptiveTimestep, AFractionAskedForIsKept) {
  Model model = test::sphere_bench();
  const double whole = step_at(model, .3);
  model.timestep_fraction = .4;
  EXPECT_NEAR(step_at(model, .3), .4 * whole, 1e-12 * whole);
}

TEST(AdaptiveTimestep, AStepAskedForStays) {
  Model model = test::sphere_bench();
  model.timestep_s = 1e-6;
  EXPECT_EQ(step_at(model, 0), 1e-6);
  EXPECT_EQ(step_at(model, 9), 1e-6);
}

TEST(AdaptiveTimestep, SmallChangesOfSpeedChangeNothing) {
  const Model model = test::sphere_bench();
  AdaptiveTimestep pace(model, kUsual_m_s);
  Simulation simulation = flying(model, .5);
  simulation.set_timestep(pace.timestep_s(simulation, 0));
  const double step = simulation.setup().timestep_s;
  for (const double speed : {.49, .5, .46}) {
    Simulation other = flying(model, speed);
    other.set_timestep(step);
    EXPECT_EQ(pace.timestep_s(other, 0), step) << speed;
  }
}

// In the middle of an impact nothing moves.
TEST(AdaptiveTimestep, WhatContactsHaveInStoreCounts) {
  const Model model = test::sphere_bench();
  const double radius = model.grain.spheres[0].radius;
  SimulationSetup setup = bulk_setup(model, {study_wall(Plane{})}, kUsual_m_s);
  setup.timestep_s *= .1;
  Simulation simulation(setup);
  simulation.add({.position = {0, 0, .8 * radius}});
  simulation.advance(1);
  const double stable = simulation.stable_timestep_s().value();
  ASSERT_LT(kBulkFraction * stable, accurate_at(model, kUsual_m_s / 9));
  EXPECT_DOUBLE_EQ(AdaptiveTimestep(model, kUsual_m_s).timestep_s(simulation, 0),
                   kBulkFraction * stable);
}

TEST(SetTimestep, TimeGoesOnFromWhereItIs) {
  Simulation simulation = flying(test::sphere_bench(), 0);
  const double first = simulation.setup().timestep_s;
  simulation.advance(10);
  simulation.set_timestep(3 * first);
  EXPECT_DOUBLE_EQ(simulation.time_s(), 10 * first);
  simulation.advance(5);
  EXPECT_DOUBLE_EQ(simulation.time_s(), 25 * first);
  EXPECT_EQ(simulation.step(), 15);
  EXPECT_NEAR(simulation.grain(0).velocity.z(), -kStandardGravity_m_s2 * 25 * first, 1e-12);
}

TEST(SetTimestep, MovingWallsDoNotJump) {
  Simulation simulation = flying(test::sphere_bench(), 0);
  simulation.set_motions(0, {{.velocity = {0, 0, .1}}});
  simulation.advance(7);
  const double before = simulation.wall(0).pose.position.z();
  simulation.set_timestep(.2 * simulation.setup().timestep_s);
  simulation.advance(1);
  EXPECT_NEAR(simulation.wall(0).pose.position.z() - before, .1 * simulation.setup().timestep_s,
              1e-15);
}

TEST(SetTimestep, OthersThanTimesAreRefused) {
  Simulation simulation = flying(test::sphere_bench(), 0);
  for (const double bad : {0.0, -1e-6, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(simulation.set_timestep(bad), base::InputError) << bad;
  }
}

TEST(SetTimestep, ACheckpointGoesOnBitForBit) {
  SimulationSetup setup = ball_scene({.restitution = .5, .sliding_friction = .3});
  setup.walls = {tilted_plane(.1)};
  setup.walls[0].motions = {{.velocity = {0, 0, .01}}};
  setup.timestep_s = accurate_timestep_s(setup, 1);
  Simulation whole(setup);
  whole.add({.position = {0, 0, 1.01 * kBallRadius_m}, .velocity = {.2, 0, -.5}});
  whole.advance(40);
  whole.set_timestep(1.3 * setup.timestep_s);
  whole.advance(33);
  Simulation resumed(whole.setup(), whole.checkpoint());
  EXPECT_EQ(resumed.time_s(), whole.time_s());
  whole.advance(500);
  resumed.advance(500);
  EXPECT_EQ(resumed.time_s(), whole.time_s());
  EXPECT_EQ(resumed.grain(0).position, whole.grain(0).position);
  EXPECT_EQ(resumed.grain(0).spin, whole.grain(0).spin);
}

// The time step changes while grains touch.
TEST(SetTimestep, WithinAnImpactHardlyChangesItsRestitution) {
  for (const double e : {.2, .5, .8}) {
    SimulationSetup setup = ball_scene({.restitution = e});
    setup.walls = {tilted_plane(0)};
    setup.gravity = Vector::Zero();
    for (const double factor : {.6, .9, 1.1, 1.6}) {
      for (int steps = 1; steps < 10; ++steps) {
        setup.timestep_s = accurate_timestep_s(setup, 1, kBulkFraction) / std::max(1.0, factor);
        Simulation simulation(setup);
        simulation.add({.position = {0, 0, kBallRadius_m}, .velocity = {0, 0, -1}});
        simulation.advance(steps);
        simulation.set_timestep(factor * setup.timestep_s);
        simulation.advance(40);
        EXPECT_NEAR(simulation.grain(0).velocity.z(), e, .02) << factor << " after " << steps;
      }
    }
  }
}

}  // namespace
}  // namespace repose::dem
