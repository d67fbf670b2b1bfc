#include <algorithm>

#include <gtest/gtest.h>

#include "dem/experiment/model_setup.h"
#include "dem/experiment/roll.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

/// Rolling distance by energy: L = S (sin - mu_r cos) / mu_r, without loss at the corner.
double by_energy_mm(double release_m, double rolling_friction) {
  const double angle = 20 * std::numbers::pi / 180;
  return 1e3 * release_m * (std::sin(angle) - rolling_friction * std::cos(angle)) /
         rolling_friction;
}

struct RollCase {
  double rolling_friction;
  double liggghts_mm;  ///< the same run in LIGGGHTS
};

class SphereRoll : public ::testing::TestWithParam<RollCase> {};

TEST_P(SphereRoll, GoesAsFarAsInAnotherEngine) {
  Model model = test::sphere_bench();
  model.grain_wall.rolling_friction = GetParam().rolling_friction;
  const Repeat repeat = run_roll(model, {}, 1);
  EXPECT_NEAR(repeat.value.value(), GetParam().liggghts_mm, .01 * GetParam().liggghts_mm);
  EXPECT_LT(repeat.value.value(), by_energy_mm(.15, GetParam().rolling_friction));
  EXPECT_NEAR(repeat.readings.at("lateral_mm"), 0, 1e-3);
  EXPECT_EQ(repeat.readings.at("stopped_on_incline"), 0);
}

INSTANTIATE_TEST_SUITE_P(Roll, SphereRoll,
                         ::testing::Values(RollCase{.04, 1013}, RollCase{.08, 437},
                                           RollCase{.17, 135}));

TEST(Roll, WhatTheCornerTakesIsSmallOnAGentleSlope) {
  Model model = test::sphere_bench();
  model.grain_wall.rolling_friction = .02;
  const Repeat repeat = run_roll(model, {.incline_deg = 5, .release_m = .1}, 1);
  const double angle = 5 * std::numbers::pi / 180;
  const double energy_mm = 100 * (std::sin(angle) - .02 * std::cos(angle)) / .02;
  EXPECT_NEAR(repeat.value.value(), energy_mm, .02 * energy_mm);
}

/// Its distance decreases to 0 without a jump at tan 20 = .364, and stays there.
TEST(Roll, AGrainThatStaysOnTheInclineCountsAsNothing) {
  Model model = test::sphere_bench();
  model.grain_wall.rolling_friction = .35;
  const Repeat barely = run_roll(model, {}, 1);
  EXPECT_EQ(barely.readings.at("stopped_on_incline"), 0);
  EXPECT_GT(barely.value.value(), 0);
  EXPECT_LT(barely.value.value(), 10);
  model.grain_wall.rolling_friction = .38;
  const Repeat stays = run_roll(model, {}, 1);
  EXPECT_EQ(stays.readings.at("stopped_on_incline"), 1);
  EXPECT_EQ(stays.readings.at("releases"), 1);
  EXPECT_EQ(stays.value.value(), 0);
}

TEST(Roll, AGrainThatStaysOnTheInclineIsReleasedAgain) {
  Model model = test::clump_bench();
  model.grain_wall.rolling_friction = .34;
  int releases = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Repeat repeat = run_roll(model, {.release_turn_deg = 90}, seed);
    EXPECT_GE(repeat.value.value(), 0);
    EXPECT_EQ(repeat.value.value() == 0, repeat.readings.at("releases") == 10);
    EXPECT_EQ(repeat.value.value() == 0, repeat.readings.at("stopped_on_incline") == 1);
    releases += static_cast<int>(repeat.readings.at("releases"));
  }
  EXPECT_GT(releases, 4);
  model.grain_wall.rolling_friction = .6;
  EXPECT_EQ(run_roll(model, {}, 1).readings.at("releases"), 10);
}

TEST(Roll, TheLongAxisLiesAcrossTheSlopeButForTheTurn) {
  const ClumpShape nut = test::clump_bench().grain;
  const auto sine_from_across = [&](const RollProtocol& protocol, Random& random) {
    const Grain grain = released(nut, protocol, random);
    const Vector long_axis = grain.orientation * lying_pose(nut).conjugate() * Vector::UnitY();
    return long_axis.dot(incline_of(protocol).down);
  };
  Random random(1);
  double left = 0, right = 0;
  for (int k = 0; k < 200; ++k) {
    const double sine = sine_from_across({.release_turn_deg = 30}, random);
    left = std::min(left, sine);
    right = std::max(right, sine);
    EXPECT_NEAR(sine_from_across({.release_turn_deg = 0}, random), 0, 1e-12);
  }
  EXPECT_NEAR(left, -.5, .02);
  EXPECT_NEAR(right, .5, .02);
}

TEST(Roll, AGrainThatDoesNotStopIsNoReadingAndSaysWhatWouldStopIt) {
  struct Case {
    PairCoefficients grain_wall;
    const char* says = "";
  };
  for (const Case& one :
       {Case{{1, .39, .04}, "less restitution between particle and wall, which is 1"},
        Case{{.31, 0, .04}, "more sliding friction between particle and wall, which is 0"},
        Case{{.31, .39, 0}, "more rolling friction between particle and wall, which is 0"}}) {
    Model model = test::sphere_bench();
    model.stiffness_factor = .001;
    model.grain_wall = one.grain_wall;
    const std::string message = error_of<NoMeasurement>([&] { run_roll(model, {}, 1); });
    EXPECT_NE(message.find("still moves"), std::string::npos) << message;
    EXPECT_NE(message.find(one.says), std::string::npos) << message;
  }
  Model model = test::sphere_bench();
  model.stiffness_factor = .001;
  model.rolling = RollingModel::none;
  const std::string message = error_of<NoMeasurement>([&] { run_roll(model, {}, 1); });
  EXPECT_NE(message.find("a rolling_model other than none"), std::string::npos) << message;
}

/// Its damper takes speed at each landing: see dem/THEORY.md; "hop_mm" triggers a warning.
TEST(Roll, ElasticPlasticHopsTakeSpeed) {
  Model model = test::sphere_bench();
  model.grain = sphere_shape(5e-3);
  model.grain_material = {"ball", 2500, 1e9, .3};
  model.rolling = RollingModel::elastic_plastic;
  model.grain_wall = {.1, .3, .01};
  const Repeat flat = run_roll(model, {}, 1);
  EXPECT_NEAR(flat.value.value(), 4420, 40);
  EXPECT_LT(flat.readings.at("hop_mm"), .05);
  model.grain_wall.restitution = .9;
  const Repeat hops = run_roll(model, {}, 1);
  EXPECT_NEAR(hops.value.value(), 1840, 40);
  // It lands at .84 m/s, of which sin 20 is normal to the flat: (.9 * .29 m/s)^2 / 2 g.
  EXPECT_NEAR(hops.readings.at("hop_mm"), 3.4, .3);
}

TEST(Roll, ClumpsComeToRestWhereTheirSeedSays) {
  Model model = test::clump_bench();
  model.grain_wall.rolling_friction = .17;
  const Repeat one = run_roll(model, {}, 1);
  model.threads = 2;
  const Repeat again = run_roll(model, {}, 1);
  EXPECT_TRUE(test::same_state(*one.state, *again.state));
  EXPECT_EQ(one.value.value(), again.value.value());
  EXPECT_NE(one.value.value(), run_roll(model, {}, 2).value.value());
}

/// Mean distance of several clumps, with steps that are a fraction of the longest.
double distance_mm(Model model, double timestep_fraction) {
  constexpr int kClumps = 4;
  model.timestep_fraction = timestep_fraction;
  double sum = 0;
  for (int seed = 1; seed <= kClumps; ++seed) {
    sum += run_roll(model, {}, static_cast<std::uint64_t>(seed)).value.value();
  }
  return sum / kClumps;
}

TEST(RollTimestep, DoesNotMatter) {
  Model model = test::clump_bench();
  model.stiffness_factor = .01;
  model.grain_wall.rolling_friction = .06;
  const double exact_mm = distance_mm(model, .2);
  EXPECT_NEAR(distance_mm(model, 1), exact_mm, .002 * exact_mm);
}

TEST(Roll, TellsEveryErrorAtOnce) {
  const std::string message = error_of([&] {
    run_roll(test::sphere_bench(), {.incline_deg = 90, .release_m = 0, .release_turn_deg = 91}, 1);
  });
  for (const char* name : {"roll.incline_deg", "roll.release_m", "roll.release_turn_deg"}) {
    EXPECT_NE(message.find(name), std::string::npos) << name << " in:\n" << message;
  }
}

}  // namespace
}  // namespace repose::dem
