#include <gmock/gmock.h>

#include "dem/engine/unstable_run.h"
#include "dem/experiment/pendulum.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class PendulumBalls : public ::testing::TestWithParam<double> {};

TEST_P(PendulumBalls, SwingAsHighAsMomentumAndRestitutionSay) {
  Model model = test::sphere_bench();
  model.grain_grain.restitution = GetParam();
  const Repeat repeat = run_pendulum(model, {.pairs = 2}, 1);
  const double ratio = std::pow((1 + GetParam()) / 2, 2);
  EXPECT_NEAR(repeat.readings.at("height_ratio"), ratio, .005);
  const double fall_mm = 300 * (1 - std::cos(std::numbers::pi / 6));
  EXPECT_NEAR(repeat.readings.at("rise_mm"), ratio * fall_mm, .005 * fall_mm);
  EXPECT_NEAR(300 * (1 - std::cos(repeat.value.value() * std::numbers::pi / 180)),
              repeat.readings.at("rise_mm"), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Pendulum, PendulumBalls, ::testing::Values(.05, .3, .5, .8, 1));

TEST(Pendulum, FrictionBetweenBallsHasNoEffect) {
  Model model = test::sphere_bench();
  const double usual = run_pendulum(model, {.pairs = 1}, 1).value.value();
  model.grain_grain.sliding_friction = .8;
  model.grain_grain.rolling_friction = .3;
  EXPECT_NEAR(run_pendulum(model, {.pairs = 1}, 1).value.value(), usual, 1e-6);
}

TEST(Pendulum, GrainsThatAreNoBallsSwingLessFarSinceTheySpin) {
  Model clump = test::clump_bench(), ball = test::sphere_bench();
  EXPECT_LT(run_pendulum(clump, {}, 1).value.value(), run_pendulum(ball, {}, 1).value.value());
  clump.grain_grain.restitution = .9;
  EXPECT_GT(run_pendulum(clump, {}, 1).value.value(),
            run_pendulum(test::clump_bench(), {}, 1).value.value() + 3);
}

TEST(Pendulum, WallsHaveNoEffectOnIt) {
  Model other = test::clump_bench();
  other.grain_wall = {.9, .05, .3};
  EXPECT_EQ(run_pendulum(other, {}, 1).value.value(),
            run_pendulum(test::clump_bench(), {}, 1).value.value());
}

TEST(Pendulum, IsTheSameAtAnyNumberOfThreads) {
  Model two = test::clump_bench();
  two.threads = 2;
  EXPECT_TRUE(test::same_state(*run_pendulum(two, {}, 5).state,
                               *run_pendulum(test::clump_bench(), {}, 5).state));
}

TEST(Pendulum, TellsEveryErrorAtOnce) {
  EXPECT_THAT(
      error_of([] {
        run_pendulum(test::sphere_bench(), {.string_m = .001, .release_deg = 120, .pairs = 0}, 1);
      }),
      AllOf(HasSubstr("pendulum.string_m is 0.001"), HasSubstr("pendulum.release_deg is 120"),
            HasSubstr("pendulum.pairs is 0")));
}

TEST(Pendulum, GrainsThatAreTooSoftStopTheRun) {
  Model soft = test::sphere_bench();
  soft.grain_material.young_modulus_pa = 1e3;
  EXPECT_THROW(run_pendulum(soft, {}, 1), UnstableRun);
}

}  // namespace
}  // namespace repose::dem
