#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/experiment/drop.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

class SphereDrop : public ::testing::TestWithParam<double> {};

TEST_P(SphereDrop, ReboundsByTheSquareOfItsRestitution) {
  Model model = test::sphere_bench();
  const double e = GetParam();
  model.grain_wall.restitution = e;
  const Repeat repeat = run_drop(model, {.height_m = .5, .grains = 2}, 1);
  // .13 mm of it is the overlap from which the rebound starts; a hundredth is for the time step.
  EXPECT_NEAR(repeat.value.value(), 500 * e * e, .01 * 500 * e * e + .2);
  EXPECT_NEAR(repeat.readings.at("sd_mm"), 0, 1e-6);
  EXPECT_NEAR(repeat.readings.at("lowest_point_rise_mm"),
              repeat.readings.at("above_first_touch_mm"), 1e-6);
  EXPECT_EQ(repeat.readings.at("never_rose"), 0);
}

INSTANTIATE_TEST_SUITE_P(Drop, SphereDrop, ::testing::Values(.05, .1, .3, .5, .9));

TEST(Drop, ClumpsReboundLessThanSpheresAndScatter) {
  const Repeat repeat = run_drop(test::clump_bench(), {.height_m = .5, .grains = 6}, 1);
  // LIGGGHTS with the same clump: 29.3 mm at 45 degrees, 32.1 flat; a sphere 48.
  EXPECT_GT(repeat.value.value(), 15);
  EXPECT_LT(repeat.value.value(), 40);
  EXPECT_GT(repeat.readings.at("sd_mm"), .5);
  EXPECT_LE(repeat.readings.at("above_first_touch_mm"), repeat.value.value());
}

TEST(Drop, TheLongestAccurateStepIsShortEnough) {
  Model model = test::clump_bench();
  const DropProtocol protocol{.height_m = .5, .grains = 5};
  const double usual = run_drop(model, protocol, 1).value.value();
  model.timestep_fraction = .1;
  // Measured with the sample's nut, as means of ten falls at restitution .05 to .9: at most .15 mm.
  EXPECT_NEAR(usual, run_drop(model, protocol, 1).value.value(), .2);
}

TEST(Drop, HalfTheHeightGivesHalfTheRebound) {
  const Model model = test::sphere_bench();
  const double high = run_drop(model, {.height_m = .5, .grains = 1}, 1).value.value();
  const double low = run_drop(model, {.height_m = .25, .grains = 1}, 1).value.value();
  EXPECT_NEAR(low / high, .5, .005);
}

TEST(Drop, FromTwoHeightsReboundsFromEachByTheSquareOfItsRestitution) {
  Model model = test::sphere_bench();
  model.grain_wall.restitution = .6;
  const DropProtocol both{.height_m = .5, .grains = 2, .low_height_m = .05};
  const Repeat repeat = run_drop(model, both, 1);
  EXPECT_NEAR(repeat.value.value(), 500 * .36, .01 * 500 * .36 + .2);
  EXPECT_NEAR(repeat.readings.at("low_rebound_mm"), 50 * .36, .01 * 50 * .36 + .1);
  const Repeat high = run_drop(model, {.height_m = .5, .grains = 2}, 1);
  const Repeat low = run_drop(model, {.height_m = .05, .grains = 2}, 1);
  EXPECT_EQ(repeat.value.value(), high.value.value());
  EXPECT_TRUE(test::same_state(*repeat.state, *high.state));
  EXPECT_EQ(repeat.readings.at("low_rebound_mm"), low.value.value()) << "the same grains again";
  EXPECT_EQ(repeat.steps, high.steps + low.steps);
  EXPECT_FALSE(high.readings.contains("low_rebound_mm"));
  const std::string wrong =
      error_of([&] { run_drop(model, {.height_m = .05, .low_height_m = .05}, 1); });
  EXPECT_NE(wrong.find("drop.low_height_m is 0.05"), std::string::npos) << wrong;
}

TEST(Drop, SameSeedSameBytesOnAnyNumberOfThreads) {
  Model model = test::clump_bench();
  const DropProtocol protocol{.height_m = .1, .grains = 3};
  const Repeat one = run_drop(model, protocol, 5);
  model.threads = 2;
  const Repeat two = run_drop(model, protocol, 5);
  EXPECT_TRUE(test::same_state(*one.state, *two.state));
  EXPECT_EQ(one.value.value(), two.value.value());
  EXPECT_NE(one.value.value(), run_drop(model, protocol, 6).value.value());
}

TEST(Drop, GrainsDoNotFeelEachOther) {
  const Model model = test::clump_bench();
  const Repeat three = run_drop(model, {.height_m = .1, .grains = 3}, 5);
  const Repeat one = run_drop(model, {.height_m = .1, .grains = 1}, 5);
  EXPECT_FALSE(one.readings.number("sd_mm")) << "of one grain nothing is known";
  // The same first pose; only the run of three lasts longer.
  EXPECT_EQ(one.state->grain_count(), 1);
  EXPECT_EQ(three.state->grain_count(), 3);
  EXPECT_GE(three.steps, one.steps);
}

TEST(Drop, ReportsAndMayBeBrokenOff) {
  int reports = 0;
  const ProgressReport report = [&](double fraction, const Simulation&) {
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
    return ++reports < 3;
  };
  EXPECT_THROW(run_drop(test::sphere_bench(), {}, 1, report), Interrupted);
  EXPECT_EQ(reports, 3);
}

TEST(Drop, TellsEveryErrorAtOnce) {
  Model model = test::sphere_bench();
  model.threads = 0;
  model.stiffness_factor = -1;
  model.timestep_fraction = 2;
  const std::string message =
      error_of([&] { run_drop(model, {.height_m = std::nan(""), .grains = 0}, 1); });
  for (const char* name :
       {"threads", "stiffness_factor", "timestep_fraction", "drop.height_m", "drop.grains"}) {
    EXPECT_NE(message.find(name), std::string::npos) << name << " in:\n" << message;
  }
}

TEST(Drop, RefusesATimestepThatIsTooLong) {
  Model model = test::sphere_bench();
  model.timestep_s = 1e-3;
  EXPECT_THROW(run_drop(model, {}, 1), base::InputError);
  model.timestep_s = 1e-6;
  EXPECT_EQ(run_drop(model, {.height_m = .05, .grains = 1}, 1).timestep_s, 1e-6);
}

TEST(Drop, AGrainWithoutSpheresIsRefused) {
  Model model = test::sphere_bench();
  model.grain = {};
  EXPECT_THROW(run_drop(model, {}, 1), base::InputError);
}

TEST(Drop, FramesShowTheGrainFromWhereItIsLetGoUntilItLiesStill) {
  const Model model = test::sphere_bench();
  const double radius_m = model.grain.reach_m();
  const DropProtocol protocol{.height_m = .1, .grains = 1};
  RunRecord record;
  record.frame_interval_s = 1e-3;
  std::vector<double> heights_m;
  record.frame = [&](const Simulation& simulation) {
    heights_m.push_back(simulation.grain(0).position.z() - radius_m);
  };
  Repeat filmed = run_drop(model, protocol, 1, {}, record);
  Repeat read = run_drop(model, protocol, 1);
  for (Repeat* repeat : {&filmed, &read}) {
    EXPECT_FALSE(repeat->readings.number("sd_mm")) << "of one grain";
    repeat->readings.erase("sd_mm");
  }
  EXPECT_EQ(filmed.value.value(), read.value.value());
  EXPECT_EQ(filmed.readings, read.readings);
  EXPECT_EQ(filmed.steps, read.steps);
  ASSERT_GT(heights_m.size(), 200U);
  EXPECT_NEAR(heights_m.front(), .1, 1e-9);
  EXPECT_NEAR(heights_m[100], .1 - .5 * kStandardGravity_m_s2 * .01, 1e-5) << "after 0.1 s of fall";
  EXPECT_NEAR(heights_m.back(), 0, 1e-5);
  // The first rebound is measured, from its lowest position to its top.
  const auto lowest = std::min_element(heights_m.begin(), heights_m.begin() + 160);
  EXPECT_NEAR(1e3 * *std::max_element(lowest, heights_m.end()),
              read.readings.at("above_first_touch_mm"), .05);
}

}  // namespace
}  // namespace repose::dem
