#include "dem/engine/rolling.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dem/engine/time_step.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr double kTimestep = 1e-6;

ContactLaw law_of(double rolling_friction) {
  ContactLaw law;
  law.reduced_young_pa = 1e9;
  law.rolling_friction = rolling_friction;
  return law;
}

Roll roll_of(const Vector& spin) {
  return {.normal = Vector::UnitZ(),
          .spin = spin,
          .normal_force = 2,
          .overlap = 1e-6,
          .reduced_radius = .005,
          .reduced_inertia = 1e-7,
          .contact_inertia = 4e-7};
}

TEST(Rolling, RelativeTorqueIsCoefficientTimesForceTimesReducedRadius) {
  const Vector torque = relative_constant_torque(roll_of({0, 8, 0}), law_of(.1), kTimestep);
  EXPECT_NEAR(torque.y(), -.1 * 2 * .005, 1e-15);
  EXPECT_EQ(torque.x(), 0);
}

TEST(Rolling, RelativeTorqueLeavesSpinAboutTheNormalAlone) {
  const Vector torque = relative_constant_torque(roll_of({3, 0, 4}), law_of(.1), kTimestep);
  EXPECT_NEAR(torque.x(), -.1 * 2 * .005 * 3 / 5, 1e-15);
  EXPECT_EQ(torque.z(), 0);
}

TEST(Rolling, RelativeTorqueNeverTakesMoreSpinThanThereIs) {
  const Roll slow = roll_of({1e-9, 0, 0});
  const Vector torque = relative_constant_torque(slow, law_of(.1), kTimestep);
  EXPECT_LE(std::abs(torque.x()) * kTimestep / slow.reduced_inertia, 1e-9);
  EXPECT_EQ(relative_constant_torque(roll_of(Vector::Zero()), law_of(.1), kTimestep).norm(), 0);
}

TEST(Rolling, ElasticPlasticSpringHasItsStiffness) {
  const ContactLaw law = law_of(.1);
  const Roll roll = roll_of({1e-3, 0, 0});
  ContactMemory memory;
  elastic_plastic_torque(roll, law, kTimestep, memory);
  const double a = std::sqrt(roll.reduced_radius * roll.overlap);
  const double normal = 4.0 / 3 * law.reduced_young_pa * a;
  const double stiffness = 2.25 * normal * std::pow(.1 * roll.reduced_radius, 2);
  EXPECT_NEAR(memory.rolling.x(), -stiffness * 1e-3 * kTimestep, 1e-12 * stiffness * 1e-9);
}

TEST(Rolling, ElasticPlasticTorqueYieldsAtTheLimitAndSpringsBack) {
  const ContactLaw law = law_of(.1);
  ContactMemory memory;
  Vector torque;
  for (int k = 0; k < 100; ++k) {
    torque = elastic_plastic_torque(roll_of({1e5, 0, 0}), law, kTimestep, memory);
  }
  EXPECT_NEAR(torque.x(), -.1 * .005 * 2, 1e-15);
  const Vector held = elastic_plastic_torque(roll_of(Vector::Zero()), law, kTimestep, memory);
  EXPECT_NEAR(held.x(), -.1 * .005 * 2, 1e-15);  // a type A model would let go here
}

TEST(Rolling, ElasticPlasticTorqueHasNoPartAboutTheNormal) {
  ContactMemory memory;
  memory.rolling = Vector(0, 1e-6, 1e-6);
  const Vector torque = elastic_plastic_torque(roll_of({1, 2, 30}), law_of(.1), kTimestep, memory);
  EXPECT_EQ(torque.z(), 0);
  EXPECT_EQ(memory.rolling.z(), 0);
}

/// Spin that two equal balls with opposite spins lose when they meet head-on without sliding
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
  return kSpin - collide(simulation, Vector::UnitZ(), kBallRadius_m).after.spin.x();
}

// What a coefficient means: between equal spheres R* is half of each one's own radius.
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

// The brake takes what there is: a ball at rest does not tremble.
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
