#include "dem/engine/rolling.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "dem/engine/time_step.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr double kRollingTimestep = 1e-6;

Law<double> rolling_law(double rolling_friction) {
  Law<double> law = {};
  law.reduced_young = 1e9;
  law.rolling_friction = rolling_friction;
  return law;
}

Roll<double> roll_of(const Vec3<double>& spin) {
  return {.normal = {0, 0, 1},
          .spin = spin,
          .normal_force = 2,
          .last_force = 2,
          .overlap = 1e-6,
          .reduced_radius = .005,
          .inertia_share = 1e-7,
          .contact_inertia = 4e-7};
}

/// The torque once the spring has reached its limit.
Vec3<double> relative_torque(const Vec3<double>& spin) {
  Vec3<double> spring;
  Vec3<double> torque;
  for (int k = 0; k < 100; ++k) {
    torque = relative_constant_torque(roll_of(spin), rolling_law(.1), kRollingTimestep, spring);
  }
  return torque;
}

TEST(Rolling, RelativeTorqueIsCoefficientTimesForceTimesReducedRadius) {
  const Vec3<double> torque = relative_torque({0, 8, 0});
  EXPECT_NEAR(torque.y, -.1 * 2 * .005, 1e-15);
  EXPECT_EQ(torque.x, 0);
}

TEST(Rolling, RelativeTorqueLeavesSpinAboutTheNormalAlone) {
  const Vec3<double> torque = relative_torque({3, 0, 4});
  EXPECT_NEAR(torque.x, -.1 * 2 * .005 * 3 / 5, 1e-15);
  EXPECT_EQ(torque.z, 0);
}

TEST(Rolling, RelativeTorqueNeverTakesMoreSpinThanThereIs) {
  Vec3<double> spring;
  const Roll<double> slow = roll_of({1e-9, 0, 0});
  const Vec3<double> torque =
      relative_constant_torque(slow, rolling_law(.1), kRollingTimestep, spring);
  EXPECT_LE(std::abs(torque.x) * kRollingTimestep / slow.inertia_share, 1e-9);
}

TEST(Rolling, RelativeTorqueHoldsOnWhereNothingSpins) {
  Vec3<double> spring = {0, .8 * .1 * 2 * .005, 0};
  const Vec3<double> held =
      relative_constant_torque(roll_of({}), rolling_law(.1), kRollingTimestep, spring);
  EXPECT_NEAR(held.y, .8 * .1 * 2 * .005, 1e-15);
}

/// For any step length and any number of contacts sharing the body: N of them together are as stiff
/// as one alone, and stop a spin without lasting overshoot.
TEST(Rolling, RelativeTorqueStopsABodyInManyContacts) {
  for (const int contacts : {1, 4, 60}) {
    constexpr double kInertia = 1e-7;
    Roll<double> roll = roll_of({1e-4, 0, 0});
    roll.inertia_share = kInertia / contacts;
    std::vector<Vec3<double>> springs(static_cast<std::size_t>(contacts));
    for (int step = 0; step < 100; ++step) {
      double torque = 0;
      for (Vec3<double>& spring : springs) {
        torque += relative_constant_torque(roll, rolling_law(.1), kRollingTimestep, spring).x;
      }
      roll.spin.x += torque * kRollingTimestep / kInertia;
    }
    EXPECT_LT(std::abs(roll.spin.x), 1e-8) << contacts;
  }
}

TEST(Rolling, ElasticPlasticSpringHasItsStiffness) {
  const Law<double> law = rolling_law(.1);
  const Roll<double> roll = roll_of({1e-3, 0, 0});
  Vec3<double> spring;
  elastic_plastic_torque(roll, law, kRollingTimestep, spring);
  const double a = std::sqrt(roll.reduced_radius * roll.overlap);
  const double normal = 4.0 / 3 * law.reduced_young * a;
  const double stiffness = 2.25 * normal * std::pow(.1 * roll.reduced_radius, 2);
  EXPECT_NEAR(spring.x, -stiffness * 1e-3 * kRollingTimestep, 1e-12 * stiffness * 1e-9);
}

TEST(Rolling, ElasticPlasticTorqueYieldsAtTheLimitAndSpringsBack) {
  const Law<double> law = rolling_law(.1);
  Vec3<double> spring;
  Vec3<double> torque;
  for (int k = 0; k < 100; ++k) {
    torque = elastic_plastic_torque(roll_of({1e5, 0, 0}), law, kRollingTimestep, spring);
  }
  EXPECT_NEAR(torque.x, -.1 * .005 * 2, 1e-15);
  const Vec3<double> held = elastic_plastic_torque(roll_of({}), law, kRollingTimestep, spring);
  EXPECT_NEAR(held.x, -.1 * .005 * 2, 1e-15);  // a type A model would let go here
}

/// Impulse of the damper until the limit is reached at a steady spin, N m s.
double damper_impulse(double timestep) {
  const Law<double> law = rolling_law(.1);
  const Roll<double> roll = roll_of({1e3, 0, 0});
  Vec3<double> spring;
  double impulse = 0;
  for (double time = 0; time < 5e-5; time += timestep) {
    const double torque = elastic_plastic_torque(roll, law, timestep, spring).x;
    impulse += (spring.x - torque) * timestep;
  }
  return impulse;
}

TEST(Rolling, ElasticPlasticDamperActsUpToWhereTheSpringYieldsHoweverLongAStepIs) {
  const Roll<double> roll = roll_of({});
  const double a = std::sqrt(roll.reduced_radius * roll.overlap);
  const double stiffness = 2.25 * 4 / 3 * 1e9 * a * std::pow(.1 * roll.reduced_radius, 2);
  const double yields_rad = .1 * roll.reduced_radius * roll.normal_force / stiffness;
  const double impulse = .6 * std::sqrt(stiffness * roll.contact_inertia) * yields_rad;
  for (const double timestep : {1e-8, 1.3e-6, 4e-6, 1.1e-5}) {
    EXPECT_NEAR(damper_impulse(timestep), impulse, 1e-9 * impulse) << timestep;
  }
}

TEST(Rolling, ElasticPlasticTorqueHasNoPartAboutTheNormal) {
  Vec3<double> spring = {0, 1e-6, 1e-6};
  const Vec3<double> torque =
      elastic_plastic_torque(roll_of({1, 2, 30}), rolling_law(.1), kRollingTimestep, spring);
  EXPECT_EQ(torque.z, 0);
  EXPECT_EQ(spring.z, 0);
}

/// Spin that two equal balls with opposite spins lose in a head-on collision without sliding
/// friction. The impulse is 2 m v, so a torque mu_r F x takes mu_r x 2 m v / (2/5 m r^2).
double spin_lost(RollingModel model, double rolling_friction, double speed) {
  SimulationSetup setup = ball_scene({.rolling_friction = rolling_friction}, model);
  setup.timestep_s = .2 * accurate_timestep_s(setup, 2 * speed);
  Simulation simulation(std::move(setup));
  constexpr double kSpin = 1000;
  for (const double side : {1.0, -1.0}) {
    Grain ball;
    ball.position.z() = side * kBallRadius_m;
    ball.velocity.z() = -side * speed;
    ball.spin.x() = side * kSpin;
    simulation.add(ball);
  }
  return kSpin - collide(simulation, kBallRadius_m).after.spin.x();
}

// The meaning of a coefficient: between equal spheres R* is half the radius of each.
TEST(Rolling, ConstantTorqueIsTwiceTheRelativeOneBetweenEqualSpheres) {
  constexpr double kFriction = .1;
  constexpr double kSpeed = .05;
  const double own = 5 * kFriction * kSpeed / kBallRadius_m;
  const double tolerance = .01 * own;  // arms are shorter than the radius by half the overlap
  EXPECT_NEAR(spin_lost(RollingModel::constant_torque, kFriction, kSpeed), own, tolerance);
  EXPECT_NEAR(spin_lost(RollingModel::relative_constant_torque, kFriction, kSpeed), own / 2,
              tolerance);
}

TEST(Rolling, WithoutAModelNothingIsLost) {
  EXPECT_NEAR(spin_lost(RollingModel::none, .1, .5), 0, 1e-9);
}

// Below the limit nothing creeps.
TEST(Rolling, BallHeldByRelativeTorqueOnAnInclineStays) {
  constexpr double kFriction = .1;
  const double tilt = std::atan(.95 * kFriction);
  SimulationSetup setup =
      ball_scene({.restitution = .5, .sliding_friction = 1, .rolling_friction = kFriction},
                 RollingModel::relative_constant_torque);
  setup.walls = {tilted_plane(tilt)};
  setup.gravity = {0, 0, -kStandardGravity_m_s2};
  setup.timestep_s = accurate_timestep_s(setup, .1);
  Simulation simulation(setup);
  simulation.add(resting_sphere(setup, tilt));
  while (simulation.time_s() < .1) simulation.advance(10);
  const Vector settled = simulation.grain(0).position;
  while (simulation.time_s() < .2) simulation.advance(10);
  EXPECT_LT((simulation.grain(0).position - settled).norm(), 1e-9);
}

// The brake takes no more than there is: a ball at rest does not tremble.
TEST(Rolling, BallBrakedByConstantTorqueStopsDead) {
  SimulationSetup setup =
      ball_scene({.restitution = .5, .sliding_friction = .5, .rolling_friction = .2},
                 RollingModel::constant_torque);
  setup.walls = {tilted_plane(0)};
  setup.gravity = {0, 0, -kStandardGravity_m_s2};
  setup.timestep_s = accurate_timestep_s(setup, .1);
  Simulation simulation(setup);
  Grain ball = resting_sphere(setup, 0);
  ball.velocity.x() = .05;
  ball.spin.y() = .05 / kBallRadius_m;
  simulation.add(ball);
  while (simulation.time_s() < .3) simulation.advance(10);
  EXPECT_EQ(simulation.grain(0).spin.norm(), 0);
  EXPECT_LT(simulation.grain(0).velocity.norm(), 1e-12);
}

}  // namespace
}  // namespace repose::dem
