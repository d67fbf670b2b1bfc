#include "calibrate/simulators/liggghts_readings.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/simulators/liggghts_scene.h"
#include "dem/contact/contact_table.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using testing::TemporaryFolder;

TEST(PrintedLines, AreFoundAmongAllElse) {
  const TemporaryFolder folder;
  const PrintedLines printed = printed_lines(folder.write(
      "output.txt",
      "LIGGGHTS (Version ...)\nreading: roll_mm -3\nslip: 22.5 0.0001\nreading: roll_mm 41.5\n"
      "reading: empty\nreading: nan_mm nan\nplace 1: 40.5\n"
      "Loop time of 0.5 on 1 procs for 1000 steps with 4 atoms, finish time now\n"
      "Loop time of 0.5 on 1 procs for 20 steps with 4 atoms, finish time now\nplace 2: 42\nprint "
      "\"reading: x 1\"\n"));
  EXPECT_THAT(printed.readings, ::testing::ElementsAre(Pair("roll_mm", 41.5)));
  EXPECT_THAT(printed.slips, ::testing::ElementsAre(Pair(22.5, .0001)));
  EXPECT_THAT(printed.places, ::testing::ElementsAre(40.5, 42));
  EXPECT_EQ(printed.steps, 1020);
  EXPECT_THAT(printed.remark, IsEmpty());
}

TEST(PrintedLines, TellWhyThereIsNoReading) {
  const TemporaryFolder folder;
  EXPECT_EQ(printed_lines(folder.write("output.txt", "a\nThe grains hang in the tube.\n")).remark,
            "The grains hang in the tube.");
  EXPECT_THAT(printed_lines(folder.write("empty.txt", "")).readings, IsEmpty());
  EXPECT_THAT(error_of([&] { printed_lines(folder.path() / "none.txt"); }), HasSubstr("none.txt"));
}

/// Down by 1 mm in the impact, then up at 1 m/s, in steps of .1 ms.
std::string flight(double up_m_s) {
  constexpr double kStep_s = 1e-4, kGravity = 9.80665, kLow_m = .01;
  std::string text = "# Time-averaged data\n# TimeStep v_z v_vz\n0 0.011 -1\n5 0.01 0\n";
  for (int k = 1; k <= 2000; ++k) {
    const double t = k * kStep_s;
    text += fmt::format("{} {} {}\n", 5 + k, kLow_m + up_m_s * t - kGravity / 2 * t * t,
                        up_m_s - kGravity * t);
  }
  return text;
}

TEST(Bounce, RisesByItsSpeedSquaredByTwiceGravity) {
  const TemporaryFolder folder;
  const auto bounce = bounce_in(folder.write("drop_1.txt", flight(1)));
  ASSERT_TRUE(bounce);
  EXPECT_NEAR(bounce->rise_m, 1 / (2 * 9.80665), 1e-7);
  EXPECT_NEAR(bounce->above_first_touch_m, 1 / (2 * 9.80665) - .001, 1e-7);
}

TEST(Bounce, OfAGrainThatStaysOnTheWallIsNone) {
  const TemporaryFolder folder;
  EXPECT_FALSE(bounce_in(folder.write("drop_1.txt", "0 0.011 -1\n5 0.01 0\n10 0.0101 0.001\n")));
  // A grain that topples is pushed by the wall: its speed does not decrease uniformly.
  EXPECT_FALSE(bounce_in(folder.write(
      "drop_2.txt", "0 0.011 -1\n5 0.01 0.3\n10 0.0101 0.2\n15 0.0102 0.15\n20 0.0102 -0.3\n")));
}

TEST(Bounce, NeedsRows) {
  const TemporaryFolder folder;
  for (const char* text : {"", "# only a head\n", "nan nan nan\n"}) {
    EXPECT_THAT(error_of([&] { bounce_in(folder.write("drop_1.txt", text)); }),
                HasSubstr("has no rows"))
        << text;
  }
}

constexpr const char* kHead =
    "ITEM: TIMESTEP\n9\nITEM: NUMBER OF ENTRIES\n{}\n"
    "ITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: ENTRIES a b\n";

std::string dump(int rows, const std::string& text) {
  return fmt::format(fmt::runtime(kHead), rows) + text;
}

TEST(DumpedGrains, HaveTheirCentresAndPoses) {
  const TemporaryFolder folder;
  const auto clumps =
      grains_in(folder.write("a.dump", dump(2, ".1 .2 .3 0 0 0 2\n-1 0 1e-3 1 0 0 0\n")), false);
  ASSERT_EQ(clumps.size(), 2U);
  EXPECT_EQ(clumps[0].position, dem::Vector(.1, .2, .3));
  EXPECT_EQ(clumps[0].orientation.z(), 1);  // normalized to length 1
  EXPECT_EQ(clumps[1].orientation.w(), 1);
  const auto balls = grains_in(folder.write("b.dump", dump(1, "7 1 .1 .2 .3 .005\n")), true);
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_EQ(balls[0].position, dem::Vector(.1, .2, .3));
  EXPECT_THAT(grains_in(folder.write("c.dump", dump(0, "")), false), IsEmpty());
}

TEST(DumpedGrains, AreRefusedWhereTheFileIsCutShort) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    return error_of([&] { grains_in(folder.write("a.dump", text), false); });
  };
  EXPECT_THAT(error(dump(2, ".1 .2 .3 1 0 0 0\n")), HasSubstr("1 rows of 2"));
  EXPECT_THAT(error(dump(1, ".1 .2 .3 1 0\n")), HasSubstr("0 rows of 1"));
  EXPECT_THAT(error(dump(1, ".1 nan .3 1 0 0 0\n")), HasSubstr("0 rows of 1"));
  EXPECT_THAT(error(""), HasSubstr("cut short"));
}

TEST(LiggghtsDecks, SayWhichRestitutionTheyHaveAnotherValueFor) {
  const auto table = [](double restitution) {
    const dem::Material wood{
        .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e7, .poisson_ratio = .3};
    return dem::ContactTable({wood}, {{.restitution = restitution}}, dem::RollingModel::none);
  };
  EXPECT_THAT(changed_restitutions(table(.05)), HasSubstr("0.0501 in place of 0.05"));
  EXPECT_THAT(changed_restitutions(table(.06)), IsEmpty());
}

}  // namespace
}  // namespace repose::calibrate
