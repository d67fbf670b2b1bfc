#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/engine/time_step.h"
#include "dem/engine/unstable_run.h"
#include "tests/dem/packing.h"
#include "tests/support/error_of.h"

namespace repose::dem {
namespace {

using ::testing::HasSubstr;

SimulationSetup ball_on_plane(double friction) {
  SimulationSetup setup = ball_scene({.restitution = .5, .sliding_friction = friction});
  setup.walls = {tilted_plane(0)};
  setup.gravity = {0, 0, -kStandardGravity_m_s2};
  setup.timestep_s = 1e-6;
  return setup;
}

std::string instability(Simulation& simulation, std::int64_t steps) {
  return error_of<UnstableRun>([&] { simulation.advance(steps); });
}

TEST(AccurateTimestep, FallsWithSpeedAndStiffnessAsTheHertzDurationDoes) {
  const SimulationSetup setup = ball_on_plane(.5);
  const double one = accurate_timestep_s(setup, .1);
  EXPECT_NEAR(accurate_timestep_s(setup, 3.2) / one, .5, 1e-9);  // v^-1/5
  Material stiff = setup.contacts.material(0);
  stiff.young_modulus_pa *= 32;
  const SimulationSetup hard =
      scene_of(setup.kinds[0].shape, stiff, stiff, setup.contacts.pair(0, 0));
  EXPECT_NEAR(accurate_timestep_s(hard, .1) / one, .25, 1e-9);  // E^-2/5
}

TEST(AccurateTimestep, SmallestGrainDecides) {
  SimulationSetup setup = ball_on_plane(.5);
  const double one = accurate_timestep_s(setup, .1);
  setup.kinds.push_back({.shape = sphere_shape(kBallRadius_m / 4), .material = 0});
  EXPECT_NEAR(accurate_timestep_s(setup, .1) / one, .25, 1e-9);  // proportional to the radius
}

TEST(AccurateTimestep, LongerStepsAreRefused) {
  const SimulationSetup setup = ball_on_plane(.5);
  const double longest = accurate_timestep_s(setup, .1);
  EXPECT_NO_THROW(check_timestep(longest, setup, .1));
  EXPECT_THAT(error_of([&] { check_timestep(1.01 * longest, setup, .1); }),
              AllOf(HasSubstr("timestep_s is"), HasSubstr("Rule: at most"), HasSubstr("Fix:")));
}

TEST(AccurateTimestep, StepsThatWouldTakeForEverAreRefused) {
  const SimulationSetup setup = ball_on_plane(.5);
  const double longest = accurate_timestep_s(setup, .1);
  EXPECT_NO_THROW(check_timestep(longest / 999, setup, .1));
  EXPECT_THAT(
      error_of([&] { check_timestep(1e-300, setup, .1); }),
      AllOf(HasSubstr("timestep_s is 1e-300"), HasSubstr("Rule: at least"), HasSubstr("Fix:")));
}

/// Ratio of kinetic energies after and before an elastic impact of two identical balls, or of one
/// with a wall.
double energy_kept(bool on_ball, double angle_rad, double late, double timestep_fraction) {
  constexpr double kSpeed = 2;
  SimulationSetup setup = ball_scene({.sliding_friction = .3});
  if (!on_ball) setup.walls = {tilted_plane(0)};
  setup.timestep_s = accurate_timestep_s(setup, kSpeed, timestep_fraction);
  Simulation simulation(setup);
  const Vector velocity = kSpeed * Vector(std::sin(angle_rad), 0, -std::cos(angle_rad));
  simulation.add({.position = {0, 0, kBallRadius_m - late * setup.timestep_s * velocity.z()},
                  .velocity = velocity});
  if (on_ball) simulation.add({.position = {0, 0, -kBallRadius_m}});
  const double before = simulation.energies().kinetic_j;
  collide(simulation, kBallRadius_m);
  return simulation.energies().kinetic_j / before;
}

/// The largest relative energy gain of such impacts: at any angle, and, for central impacts,
/// wherever in a step the contact begins.
double energy_made(bool on_ball, double timestep_fraction) {
  double most = 0;
  for (int k = 0; k < 90 + 16; ++k) {
    const double angle_rad = std::max(0, k - 16) * kDegree;
    most = std::max(most, energy_kept(on_ball, angle_rad, k % 16 / 16.0, timestep_fraction) - 1);
  }
  return most;
}

TEST(LongTimestep, ElasticImpactsMakeLittleEnergy) {
  for (const double share : {1.0, .94, .88, .8}) {
    for (const bool on_ball : {false, true}) {
      EXPECT_LT(energy_made(on_ball, share * kCourseFraction), 1e-3) << share;
      EXPECT_LT(energy_made(on_ball, share * kBulkFraction), 6e-3) << share;
    }
  }
  EXPECT_GT(energy_made(false, kBulkFraction), 1e-5) << "some: the steps are long";
}

TEST(LongTimestep, IsRefusedForSingleImpacts) {
  const SimulationSetup setup = ball_on_plane(.5);
  for (const double fraction : {kCourseFraction, kBulkFraction}) {
    const double step = accurate_timestep_s(setup, .1, fraction);
    EXPECT_NO_THROW(check_timestep(step, setup, .1, fraction));
    EXPECT_THROW(check_timestep(step, setup, .1), base::InputError);
  }
}

TEST(StableTimestep, NoContactsSetNoLimit) {
  Simulation simulation(ball_on_plane(.5));
  Grain ball;
  ball.position.z() = 1;
  simulation.add(ball);
  simulation.advance(1);
  EXPECT_FALSE(simulation.stable_timestep_s().has_value());
}

TEST(StableTimestep, BallOnAFrictionlessPlaneSwingsAsHertzSays) {
  const SimulationSetup setup = ball_on_plane(0);
  Simulation simulation(setup);
  simulation.add(resting_sphere(setup, 0));
  simulation.advance(1);
  const double overlap = simulation.deepest_overlap() * kBallRadius_m;
  const double stiffness =
      2 * setup.contacts.law(0, 1).reduced_young_pa * std::sqrt(kBallRadius_m * overlap);
  EXPECT_NEAR(*simulation.stable_timestep_s(), 2 / std::sqrt(stiffness / simulation.mass_kg(0)),
              1e-12);
}

// Tangentially a ball swings about its contact: 1/m_eff = 1/m + r^2 / (2/5 m r^2) = 7/2 / m.
TEST(StableTimestep, FrictionAddsTheSwingAboutTheContact) {
  const SimulationSetup setup = ball_on_plane(.5);
  Simulation simulation(setup);
  simulation.add(resting_sphere(setup, 0));
  simulation.advance(1);
  const double overlap = simulation.deepest_overlap() * kBallRadius_m;
  const double stiffness =
      8 * setup.contacts.law(0, 1).reduced_shear_pa * std::sqrt(kBallRadius_m * overlap);
  const double expected = 2 / std::sqrt(3.5 * stiffness / simulation.mass_kg(0));
  EXPECT_NEAR(*simulation.stable_timestep_s(), expected, 2e-3 * expected);
}

TEST(StableTimestep, SettledPackingStaysAtRestAtTheAcceptedStep) {
  SimulationSetup setup = packing_setup();
  setup.timestep_s = accurate_timestep_s(setup, 1, kCourseFraction);
  Simulation simulation = loose_packing(setup, 16);
  const double fall_j = simulation.mass_kg(0) * kStandardGravity_m_s2 * .001;
  const auto settle = [&simulation](double until_s, double rest_j) {
    do {
      simulation.advance(100);
    } while (simulation.time_s() < until_s && simulation.energies().kinetic_j > rest_j);
    return simulation.time_s();
  };
  const double settled = settle(3, 1e-9 * fall_j);
  ASSERT_LT(settled, 3);
  ASSERT_GT(simulation.contacts().size(), 30U);
  EXPECT_GT(*simulation.stable_timestep_s(), setup.timestep_s);
  std::vector<Vector> rest;
  for (int k = 0; k < 16; ++k) rest.push_back(simulation.grain(k).position);
  settle(settled + .3, 0);
  EXPECT_LT(simulation.energies().kinetic_j, 1e-9 * fall_j);
  for (int k = 0; k < 16; ++k) {
    EXPECT_LT((simulation.grain(k).position - rest[static_cast<std::size_t>(k)]).norm(), 1e-6);
  }
}

/// A cube of 27 balls pressed together by six walls, each ball having six contacts.
Simulation pressed_cube(const PairCoefficients& pair, double timestep_s) {
  constexpr double kPitch_m = 1.99 * kBallRadius_m;
  SimulationSetup setup = ball_scene(pair);
  setup.gravity = Vector::Zero();
  setup.timestep_s = timestep_s;
  setup.audit_steps = 1 << 20;
  const Vector up = Vector::UnitZ();
  for (int k = 0; k < 6; ++k) {
    const Vector inwards = (k % 2 == 0 ? 1 : -1) * Vector::Unit(k / 2);
    setup.walls.push_back({.shape = Plane{},
                           .material = 1,
                           .pose = {.position = -1.5 * kPitch_m * inwards,
                                    .orientation = Quaternion::FromTwoVectors(up, inwards)}});
  }
  Simulation simulation(std::move(setup));
  for (int k = 0; k < 27; ++k) {
    const int layer = k / 9, row = k / 3 % 3, column = k % 3;
    const Vector cell(layer - 1, row - 1, column - 1);
    const Vector turn(std::sin(1.0 + k), std::sin(2.1 * k), std::cos(3.3 * k));
    simulation.add(
        {.position = kPitch_m * cell, .velocity = 1e-4 * turn, .spin = 1e-2 * turn.reverse()});
  }
  return simulation;
}

/// Kinetic energy of such a cube after 5000 steps, relative to the initial one.
double motion_left(const PairCoefficients& pair, double timestep_fraction) {
  Simulation probe = pressed_cube(pair, 1e-9);
  probe.advance(1);
  Simulation simulation = pressed_cube(pair, timestep_fraction * *probe.stable_timestep_s());
  const double before = simulation.energies().kinetic_j;
  simulation.advance(5000);
  return simulation.energies().kinetic_j / before;
}

// The damping of six contacts adds up.
TEST(RoughDeadGrains, PressedTogetherComeToRestInAcceptedSteps) {
  for (const double e : {.01, .06, .2, .5}) {
    for (const double fraction : {kImpactFraction, kCourseFraction, kBulkFraction}) {
      EXPECT_LT(motion_left({.restitution = e, .sliding_friction = 100}, fraction), 1e-6)
          << "restitution " << e << ", step " << fraction;
    }
  }
}

TEST(Audit, TooLongAStepIsCaughtByItsContacts) {
  SimulationSetup setup = ball_on_plane(.5);
  Simulation probe(setup);
  probe.add(resting_sphere(setup, 0));
  probe.advance(1);
  setup.timestep_s = 1.2 * *probe.stable_timestep_s();
  setup.audit_steps = 1;
  Simulation simulation(setup);
  simulation.add(resting_sphere(setup, 0));
  EXPECT_THAT(instability(simulation, 100), HasSubstr("Fix: a shorter time step"));
}

TEST(Audit, PackingAtTooLongAStepIsCaught) {
  SimulationSetup setup = packing_setup();
  setup.timestep_s = 20 * accurate_timestep_s(setup, 1);
  setup.audit_steps = 20;
  Simulation simulation = loose_packing(setup, 16);
  EXPECT_THAT(instability(simulation, 20000), HasSubstr("the run was stopped"));
}

TEST(Audit, DeepOverlapIsCaught) {
  SimulationSetup setup = ball_on_plane(.5);
  setup.audit_steps = 1;
  Simulation simulation(setup);
  Grain ball;
  ball.position.z() = .6 * kBallRadius_m;
  simulation.add(ball);
  EXPECT_THAT(instability(simulation, 1), HasSubstr("% of a radius"));
}

/// A ball just above the plane, moving at 1 m/s.
Simulation falling_ball(SimulationSetup setup) {
  Grain ball;
  ball.position.z() = 1.001 * kBallRadius_m;
  ball.velocity.z() = -1;
  Simulation simulation(std::move(setup));
  simulation.add(ball);
  return simulation;
}

SimulationSetup ball_as_stiff_as(double young_pa) {
  const SimulationSetup usual = ball_on_plane(.5);
  Material material = usual.contacts.material(0);
  material.young_modulus_pa = young_pa;
  SimulationSetup setup =
      scene_of(usual.kinds[0].shape, material, material, usual.contacts.pair(0, 0));
  setup.walls = usual.walls;
  setup.timestep_s = accurate_timestep_s(setup, 1);
  return setup;
}

TEST(Audit, AnImpactBetweenTwoAuditsIsSeen) {
  Simulation stiff = falling_ball(ball_as_stiff_as(1e7));
  EXPECT_EQ(instability(stiff, 200), "");
  Simulation soft = falling_ball(ball_as_stiff_as(1e3));
  EXPECT_THAT(instability(soft, 200),
              AllOf(HasSubstr("% of a radius"), HasSubstr("Fix: a larger young_modulus_pa")));
}

TEST(Audit, ATooLongStepIsSeenAtAnImpactBetweenTwoAudits) {
  SimulationSetup setup = ball_as_stiff_as(1e7);
  setup.timestep_s *= 20;
  Simulation simulation = falling_ball(setup);
  EXPECT_THAT(instability(simulation, 200), HasSubstr("Fix: a shorter time step"));
}

/// A ball resting on the plane, so heavy that it is pressed in by this fraction of its radius.
Simulation ball_pressed_in(double fraction) {
  SimulationSetup setup = ball_on_plane(.5);
  const double usual = 1 - resting_sphere(setup, 0).position.z() / kBallRadius_m;
  setup.gravity *= std::pow(fraction / usual, 1.5);
  setup.audit_steps = 20;
  Simulation simulation(setup);
  simulation.add(resting_sphere(setup, 0));
  return simulation;
}

TEST(Audit, AGrainThatHasSunkIntoWhatItLiesOnIsSeen) {
  Simulation shallow = ball_pressed_in(.19);
  EXPECT_EQ(instability(shallow, 200), "");
  Simulation deep = ball_pressed_in(.22);
  EXPECT_THAT(instability(deep, 200),
              AllOf(HasSubstr("has sunk into what it lies on by 22 % of a radius"),
                    HasSubstr("Fix: a young_modulus_pa or stiffness_factor at least 2.3 times")));
}

TEST(Audit, QuietRunPasses) {
  SimulationSetup setup = packing_setup();
  setup.timestep_s = accurate_timestep_s(setup, 1);
  setup.audit_steps = 10;
  Simulation simulation = loose_packing(setup, 8);
  EXPECT_EQ(instability(simulation, 5000), "");
}

}  // namespace
}  // namespace repose::dem
