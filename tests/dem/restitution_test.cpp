#include "dem/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/engine/time_step.h"
#include "dem/verify/scene.h"
#include "tests/support/error_of.h"

namespace repose::dem {
namespace {

constexpr double kBallRadius = .004;
constexpr double kSpeed_m_s = 1.5;

SimulationSetup glass_on_wall(double restitution, double poisson_ratio = .24) {
  const Material glass{.name = "glass",
                       .density_kg_m3 = 2500,
                       .young_modulus_pa = 6e10,
                       .poisson_ratio = poisson_ratio};
  SimulationSetup setup =
      scene_of(sphere_shape(kBallRadius), glass, glass, {.restitution = restitution});
  setup.walls = {tilted_plane(0)};
  return setup;
}

/// A central impact whose first contact is a fraction `late` of a step after the start: with the
/// wall or, if there is none, with an identical ball at rest.
Collision impact(const SimulationSetup& setup, double late) {
  Simulation simulation(setup);
  Grain grain;
  grain.position.z() = kBallRadius + late * setup.timestep_s * kSpeed_m_s;
  grain.velocity.z() = -kSpeed_m_s;
  simulation.add(grain);
  if (setup.walls.empty()) simulation.add({.position = {0, 0, -kBallRadius}});
  return collide(simulation, kBallRadius);
}

/// Ratio of separation speed to approach speed.
double restitution_seen(const SimulationSetup& setup, double late) {
  const double after = impact(setup, late).after.velocity.z() / kSpeed_m_s;
  return setup.walls.empty() ? 1 + 2 * after : after;
}

/// The factor -2 sqrt(5/6) ln e / sqrt(pi^2 + ln^2 e) for a contact that may pull.
double textbook_factor(double restitution) {
  const double log = std::log(restitution);
  return -2 * std::sqrt(5.0 / 6) * log / std::hypot(std::numbers::pi, log);
}

TEST(Restitution, FactorAndRestitutionAreInverse) {
  for (double e = .01; e <= 1; e += .01) {
    EXPECT_NEAR(restitution_of(damping_factor(e)), e, 1e-6) << e;
  }
}

TEST(Restitution, ElasticContactIsNotDamped) {
  EXPECT_EQ(damping_factor(1), 0);
  EXPECT_NEAR(restitution_of(0), 1, 1e-6);
}

TEST(Restitution, LessRestitutionNeedsMoreDamping) {
  for (double e = .02; e <= 1; e += .01) EXPECT_LT(damping_factor(e), damping_factor(e - .01));
}

TEST(Restitution, OutOfRangeIsRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double e : {-1.0, 0.0, .0099, 1.0001, kNan, kInfinity}) {
    EXPECT_THROW(damping_factor(e), base::InputError) << e;
  }
  EXPECT_THAT(error_of([] { damping_factor(1.5); }),
              ::testing::AllOf(::testing::HasSubstr("1.5"), ::testing::HasSubstr("Fix:")));
}

// Why the factor is recalculated: with the pull cut off, the textbook's gives too high a rebound.
TEST(Restitution, TextbookFactorReturnsTooMuch) {
  EXPECT_NEAR(restitution_of(textbook_factor(.1)), .25, .01);
  EXPECT_NEAR(restitution_of(textbook_factor(.3)), .40, .01);
  EXPECT_NEAR(restitution_of(textbook_factor(.5)), .55, .01);
}

/// Largest errors of restitution: of a single impact, wherever in a step it begins, and of the mean
/// of many.
struct WorstError {
  double of_one = 0;
  double of_mean = 0;
};

WorstError worst_error(SimulationSetup setup, double restitution, double timestep_fraction,
                       bool on_ball) {
  constexpr int kPhases = 8;
  const double longest = accurate_timestep_s(setup, kSpeed_m_s, timestep_fraction);
  if (on_ball) setup.walls.clear();
  WorstError worst;
  for (const double share : {1.0, .97, .94, .9, .8, .6, .3}) {
    setup.timestep_s = share * longest;
    double mean = 0;
    for (int phase = 0; phase < kPhases; ++phase) {
      const double error = restitution_seen(setup, 1.0 * phase / kPhases) - restitution;
      worst.of_one = std::max(worst.of_one, std::abs(error));
      mean += error / kPhases;
    }
    worst.of_mean = std::max(worst.of_mean, std::abs(mean));
  }
  return worst;
}

// The larger Poisson's ratio, the fewer steps an impact takes along the normal.
TEST(Restitution, ComesOutAtEveryAcceptedTimestep) {
  for (const double poisson_ratio : {0.0, .24, .49}) {
    for (int percent = 5; percent <= 100; percent += 5) {
      const double e = percent / 100.0;
      const SimulationSetup setup = glass_on_wall(e, poisson_ratio);
      for (const bool on_ball : {false, true}) {
        EXPECT_LT(worst_error(setup, e, kImpactFraction, on_ball).of_one, .0005) << e;
        EXPECT_LT(worst_error(setup, e, kCourseFraction, on_ball).of_one, .002) << e;
        const WorstError of_bulks = worst_error(setup, e, kBulkFraction, on_ball);
        EXPECT_LT(of_bulks.of_one, .012) << e;
        EXPECT_LT(of_bulks.of_mean, .002) << e;
      }
    }
  }
}

TEST(Restitution, ConvergesWithTheTimestep) {
  for (const double e : {.05, .3, .7}) {
    SimulationSetup setup = glass_on_wall(e);
    setup.timestep_s = .01 * accurate_timestep_s(setup, kSpeed_m_s);
    EXPECT_NEAR(impact(setup, .5).after.velocity.z() / kSpeed_m_s, e, 1e-4);
  }
}

// Four equal contacts side by side: four times the stiffness and damping, so twice the factor.
TEST(Restitution, BlockThatLandsOnFourSpheresRisesLess) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
  for (const double e : {.3, .5, .8}) {
    SimulationSetup setup =
        scene_of(block_shape({.02, .02, .01}, .005), wood, wood, {.restitution = e});
    setup.walls = {tilted_plane(0)};
    setup.timestep_s = .1 * accurate_timestep_s(setup, 1);
    Simulation simulation(setup);
    Grain block;
    block.position.z() = .01;
    block.velocity.z() = -1;
    simulation.add(block);
    const double out = collide(simulation, .005).after.velocity.z();
    EXPECT_NEAR(out, restitution_of(2 * damping_factor(e)), .002);
    EXPECT_LT(out, e - .05);
  }
}

TEST(Restitution, ContactNeverPulls) {
  for (const double e : {.05, .2, .5, .9, 1.0}) {
    SimulationSetup setup = glass_on_wall(e);
    for (const double fraction : {1.0, .3}) {
      setup.timestep_s = fraction * accurate_timestep_s(setup, kSpeed_m_s);
      EXPECT_EQ(impact(setup, .3).pull_n, 0) << e;
    }
  }
}

/// For a contact whose restitution depends on the speed.
SimulationSetup by_speed(double restitution, double exponent, double young_pa = 1e9) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = young_pa, .poisson_ratio = .3};
  SimulationSetup setup = scene_of(sphere_shape(kBallRadius), wood, wood,
                                   {.restitution = restitution,
                                    .restitution_exponent = exponent,
                                    .restitution_speed_m_s = kSpeed_m_s});
  setup.walls = {tilted_plane(0)};
  setup.timestep_s = .5 * accurate_timestep_s(setup, kSpeed_m_s, kImpactFraction);
  return setup;
}

TEST(RestitutionBySpeed, BothAWallAndAnotherBallRestoreWhatTheLawSays) {
  for (const double e : {.1, .3, .5, .8}) {
    for (const double exponent : {.05, .15, .25}) {
      SimulationSetup setup = by_speed(e, exponent);
      EXPECT_NEAR(restitution_seen(setup, .5), e, .01 * e) << exponent;
      setup.walls.clear();
      EXPECT_NEAR(restitution_seen(setup, .5), e, .01 * e) << exponent << " balls";
    }
  }
}

/// The law has no scale other than its own speed: neither stiffness nor mass matters.
TEST(RestitutionBySpeed, DoesNotDependOnTheStiffness) {
  EXPECT_NEAR(restitution_seen(by_speed(.4, .2, 1e7), .5), .4, .004);
  EXPECT_NEAR(restitution_seen(by_speed(.4, .2, 1e11), .5), .4, .004);
}

TEST(RestitutionBySpeed, WithoutAnExponentIsTheSameToTheBit) {
  SimulationSetup plain = glass_on_wall(.4);
  plain.timestep_s = accurate_timestep_s(plain, kSpeed_m_s);
  SimulationSetup zero = plain;
  PairCoefficients pair = plain.contacts.pair(0, 0);
  pair.restitution_speed_m_s = 3;
  zero.contacts = ContactTable({plain.contacts.material(0), plain.contacts.material(1)},
                               {pair, pair, pair, pair}, RollingModel::none);
  EXPECT_FALSE(zero.contacts.is_by_speed());
  EXPECT_EQ(impact(plain, .3).after.velocity.z(), impact(zero, .3).after.velocity.z());
}

TEST(RestitutionBySpeed, IsHeldBetweenItsLeastAndItsMost) {
  const PairCoefficients pair{
      .restitution = .5, .restitution_exponent = .25, .restitution_speed_m_s = 1};
  EXPECT_DOUBLE_EQ(restitution_at(pair, 16), .25);
  EXPECT_DOUBLE_EQ(restitution_at(pair, .01), kMaxRestitutionBySpeed);
  EXPECT_DOUBLE_EQ(restitution_at(pair, 1e9), kMinRestitution);
  EXPECT_EQ(restitution_at({.restitution = .5}, .01), .5);
}

TEST(RestitutionBySpeed, WhatItCannotBeIsRefused) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e9, .poisson_ratio = .3};
  const auto error = [&](const PairCoefficients& pair) {
    return error_of([&] { ContactTable({wood}, {pair}, RollingModel::none); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error({.restitution = .5, .restitution_exponent = .3, .restitution_speed_m_s = 1}),
              HasSubstr("restitution_exponent is 0.3. Rule: 0 to .25"));
  EXPECT_THAT(error({.restitution = .5, .restitution_exponent = .1}),
              HasSubstr("restitution_speed_m_s is 0. Rule: above 0"));
  EXPECT_THAT(error({.restitution = 1, .restitution_exponent = .1, .restitution_speed_m_s = 1}),
              HasSubstr("restitution is 1. Rule: at most .99"));
}

}  // namespace
}  // namespace repose::dem
