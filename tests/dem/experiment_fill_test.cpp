#include <algorithm>

#include <gmock/gmock.h>

#include "dem/engine/unstable_run.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/filling.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Balls of 20 mm, soft to keep runs short.
Model balls_to_fill() {
  Model model = test::sphere_bench();
  model.grain = sphere_shape(.01);
  model.grain_material = {"ball", 1000, 1e6, .3};
  return model;
}

constexpr FillProtocol kTubeToFill{.tube_diameter_m = .15, .tube_height_m = .15};

TEST(FilledTube, ItsDensityIsThatOfTheGrainsCountedInTheTube) {
  const Repeat repeat = run_fill(balls_to_fill(), kTubeToFill, 1);
  const double grain_kg = 1000 * 4.0 / 3 * std::numbers::pi * 1e-6;
  const double tube_m3 = std::numbers::pi / 4 * .15 * .15 * .15;
  const double grains = repeat.readings.at("grains");
  EXPECT_NEAR(repeat.value.value(), grains * grain_kg / tube_m3, 1e-9);
  EXPECT_NEAR(repeat.readings.at("mass_g"), 1e3 * grains * grain_kg, 1e-9);
  EXPECT_NEAR(repeat.readings.at("solid_fraction"), repeat.value.value() / 1000, 1e-12);
  for (int k = 0; k < repeat.state->grain_count(); ++k) {
    if (!repeat.state->is_present(k)) continue;
    EXPECT_LT(repeat.state->grain(k).position.z(), .15);
  }
}

TEST(FilledTubes, BallsPackAsPouredBallsDo) {
  Model model = balls_to_fill();
  model.grain_material.young_modulus_pa = 1e7;
  // Balls poured loosely into a tube of 7.5 diameters fill .568 of it (Zou and Yu 1995, Chemical
  // Engineering Science 50, 1504); a tube as low as this one lacks half a layer at the bottom.
  EXPECT_NEAR(run_fill(model, kTubeToFill, 1).readings.at("solid_fraction"), .568 * (1 - .01 / .15),
              .03);
}

TEST(FilledTubes, FrictionMakesLooserPackings) {
  Model smooth = balls_to_fill(), rough = balls_to_fill();
  smooth.grain_grain = {.3, .05, .01};
  rough.grain_grain = {.3, .8, .3};
  EXPECT_LT(run_fill(rough, kTubeToFill, 1).value.value(),
            run_fill(smooth, kTubeToFill, 1).value.value() - 20);
}

// 2 kg/s: the time for the 1.4 kg in the tube and the heap above its rim.
TEST(FilledTubes, PouredSlowlyTheyTakeTheirTimeAndLieDenser) {
  FillProtocol slow = kTubeToFill;
  slow.pour_kg_s = 2;
  const auto pouring_s = [](const FillProtocol& tube, Repeat& repeat) {
    double longest_s = 0;
    repeat = run_fill(balls_to_fill(), tube, 1, [&](double, const Simulation& simulation) {
      longest_s = std::max(longest_s, simulation.time_s());
      return true;
    });
    return longest_s;
  };
  Repeat fast_fill, slow_fill;
  const double fast_s = pouring_s(kTubeToFill, fast_fill);
  const double slow_s = pouring_s(slow, slow_fill);
  const double heaped_s = 1e-3 * slow_fill.readings.at("mass_g") / *slow.pour_kg_s;
  EXPECT_LT(fast_s, heaped_s + .3);
  EXPECT_GT(slow_s, heaped_s);
  EXPECT_GT(slow_fill.value.value(), fast_fill.value.value());
}

TEST(FilledTubes, TapsMakeItDenserAndNeverDenserThanBallsCanBe) {
  FillProtocol tube = kTubeToFill;
  tube.tap_m = .01;
  const Repeat poured = run_fill(balls_to_fill(), tube, 1);
  tube.taps = 1;
  const Repeat once = run_fill(balls_to_fill(), tube, 1);
  tube.taps = 4;
  const Repeat often = run_fill(balls_to_fill(), tube, 1);
  EXPECT_EQ(poured.readings.count("hausner_ratio"), 0U);
  EXPECT_GT(once.readings.at("hausner_ratio"), 1);
  EXPECT_GT(often.readings.at("hausner_ratio"), once.readings.at("hausner_ratio"));
  EXPECT_NEAR(often.value.value() / often.readings.at("hausner_ratio"), poured.value.value(),
              .05 * poured.value.value())
      << "below the collar it is poured as without";
  // Random close packing (Scott and Kilgour 1969, J. Phys. D 2, 863).
  EXPECT_LT(often.readings.at("solid_fraction"), .637);
}

TEST(FilledTube, ItsLevelIsAtTheRimGiveOrTakeAGrain) {
  const double level_mm =
      run_fill(balls_to_fill(), kTubeToFill, 1).readings.at("filling_height_mm");
  EXPECT_GT(level_mm, 130);
  EXPECT_LT(level_mm, 155);
}

TEST(FillingHeight, IsTheMeanOverTheTube) {
  EXPECT_EQ(filling_height_m({}, .1), 0);
  // A sphere as wide as the tube, centred at 0.2 m: a dome of mean height 2/3 r.
  const std::vector<ClumpSphere> dome = {{.centre = {0, 0, .2}, .radius = .05}};
  EXPECT_NEAR(filling_height_m(dome, .1), .2 + .05 * 2 / 3, 1e-4);
  // One that covers a quarter of the tube, and one hidden below it.
  const std::vector<ClumpSphere> ball = {{.centre = {.01, .02, .2}, .radius = .025},
                                         {.centre = {.01, .02, .1}, .radius = .02}};
  EXPECT_NEAR(filling_height_m(ball, .1), (.2 + .025 * 2 / 3) / 4, 5e-4);
}

TEST(FillingHeight, SpheresBeyondTheTubeCountAsFarAsTheyReachIn) {
  const std::vector<ClumpSphere> outside = {{.centre = {.2, 0, .2}, .radius = .05}};
  EXPECT_EQ(filling_height_m(outside, .1), 0);
  const std::vector<ClumpSphere> wide = {{.centre = {0, 0, -1}, .radius = 1.1}};
  EXPECT_NEAR(filling_height_m(wide, .1), .1 - .05 * .05 / 4 / 1.1, 1e-5);
}

TEST(FilledTubeThreads, GiveTheSame) {
  Model two = balls_to_fill();
  two.threads = 2;
  const Repeat one = run_fill(balls_to_fill(), kTubeToFill, 3);
  EXPECT_TRUE(test::same_state(*one.state, *run_fill(two, kTubeToFill, 3).state));
}

TEST(FilledTube, TellsEveryErrorAtOnce) {
  EXPECT_THAT(error_of([] {
                run_fill(balls_to_fill(),
                         {.tube_diameter_m = .03, .tube_height_m = .02, .pour_m = 0}, 1);
              }),
              AllOf(HasSubstr("fill.tube_diameter_m is 0.03"), HasSubstr("4 grains or more"),
                    HasSubstr("fill.tube_height_m is 0.02"), HasSubstr("fill.pour_m is 0")));
  EXPECT_THAT(error_of([] {
                FillProtocol tapped = kTubeToFill;
                tapped.taps = 0;
                tapped.tap_m = .2;
                run_fill(balls_to_fill(), tapped, 1);
              }),
              AllOf(HasSubstr("fill.taps is 0"), HasSubstr("fill.tap_m is 0.2"),
                    HasSubstr("at most the tube's height, 0.15")));
  EXPECT_THAT(error_of([] {
                FillProtocol slow = kTubeToFill;
                slow.pour_kg_s = 1e-6;
                run_fill(balls_to_fill(), slow, 1);
              }),
              AllOf(HasSubstr("fill.pour_kg_s is 1e-06. Rule: 0.02"), HasSubstr("in 60 s")));
  EXPECT_THAT(
      error_of([] { run_fill(balls_to_fill(), {.tube_diameter_m = 9, .tube_height_m = 9}, 1); }),
      HasSubstr("Rule: at most 100000. Fix: a smaller tube"));
}

TEST(FilledTube, GrainsThatAreTooSoftStopTheRun) {
  Model soft = balls_to_fill();
  soft.grain_material.young_modulus_pa = 1e3;
  EXPECT_THROW(run_fill(soft, kTubeToFill, 1), UnstableRun);
}

}  // namespace
}  // namespace repose::dem
