#include <string>

#include <gmock/gmock.h>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

const Words kSoybean = {"soybean.toml", "--grains",    "soybean",   "--plate", "acrylic",
                        "--grain-mm",   "7.6,6.9,6.2", "--tube-mm", "50x150"};

struct NewCommand : CommandTest {
  NewCommand() : CommandTest({"new"}) {}
};

std::vector<std::string> lines_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(NewCommand, WritesAStudyAndSheetsWhoseColumnsNameTheirUnits) {
  const Finished done = run(kSoybean);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("Wrote soybean.toml: Soybeans on acrylic"),
                              HasSubstr("soybean/drops.csv"), HasSubstr("1. fill in the sheets"),
                              HasSubstr("repose calibrate soybean.toml"),
                              HasSubstr("repose report soybean_calibration")));
  EXPECT_THAT(text("soybean.toml"),
              AllOf(HasSubstr("size_mm = [7.6, 6.9, 6.2]"), HasSubstr("tube_diameter_mm = 50\n"),
                    HasSubstr("name = \"acrylic\""), HasSubstr("Boac et al. (2010)")));
  EXPECT_EQ(text("soybean/drops.csv"), "drop_mm,rebound_mm\n");
  EXPECT_EQ(text("soybean/tilts.csv"), "angle_deg\n");
  EXPECT_EQ(text("soybean/rolls.csv"), "incline_deg,released_mm,stopped_mm\n");
  EXPECT_EQ(text("soybean/heaps.csv"), "angle_deg\n");
  EXPECT_THAT(lines_in(text("soybean.toml")),
              Each(::testing::ResultOf(base::letters, ::testing::Le(100U))));
}

TEST_F(NewCommand, PowdersAreSaidToStick) {
  const Finished done = run({"p.toml", "--grain-mm", "0.1,0.1,0.1", "--tube-mm", "2x4"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("grains of 0.1 mm and 1200 kg/m3 would stick"));
}

TEST_F(NewCommand, TheStudyRunsOnceItsSheetsAreFilledIn) {
  ASSERT_EQ(run(kSoybean).exit_code, 0);
  const Finished empty = run_repose(folder_, {"calibrate", "soybean.toml"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(lines_in(empty.err), AllOf(SizeIs(4), Each(HasSubstr("no readings yet: fill in"))));

  folder_.write("soybean/tilts.csv", std::string("angle_deg\n18.5;1\n19.1;2\n"));
  const Finished wrong = run_repose(folder_, {"simulate", "tilt", "soybean.toml"});
  EXPECT_THAT(wrong.err, HasSubstr("soybean/tilts.csv:2: the row has 2 cells"));
  folder_.write("soybean/tilts.csv", std::string("angle_deg\n18,5\n19,1\n"));
  const Finished done = run_repose(folder_, {"simulate", "tilt", "soybean.toml"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("measured 18.800"));
}

TEST_F(NewCommand, AllWrongOptionsAreToldAtOnceAndNothingIsWritten) {
  const Finished done =
      run({"soybean.txt", "--grains", "soybeen", "--plate", "glas", "--grain-mm", "7.6,6.9",
           "--density-kg-m3", "1.2", "--tube-mm", "50", "--experiments", "drop,heep"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(
      done.err,
      AllOf(
          HasSubstr("soybean.txt: a study's name ends in .toml. Fix: repose new soybean.toml"),
          HasSubstr("kind of grain (--grains) is soybeen, which is unknown. Did you mean soybean?"),
          HasSubstr("plate (--plate) is glas, which is unknown. Did you mean glass?"),
          HasSubstr("--grain-mm 7.6,6.9: must be length, width and thickness"),
          HasSubstr("density (--density-kg-m3) is 1.2. Rule: a number of kg/m3 from 10 to 25000"),
          HasSubstr("--tube-mm 50: must be"), HasSubstr("experiments (--experiments) is heep")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(NewCommand, PartsOfAnotherMaterialHaveSectionsOfTheirOwn) {
  ASSERT_EQ(run({"a.toml", "--tube", "acrylic", "--incline", "steel"}).exit_code, 0);
  EXPECT_THAT(text("a.toml"),
              AllOf(HasSubstr("[wall.tube]\nname = \"acrylic\"\n"),
                    HasSubstr("[contact.particle_tube]\n# Assumed. Drop, tilt and roll"),
                    Not(HasSubstr("[wall.incline]"))))
      << "it is as the plate";
  folder_.write("a/tilts.csv", std::string("angle_deg\n18.5\n19.1\n"));
  EXPECT_EQ(run_repose(folder_, {"simulate", "tilt", "a.toml"}).exit_code, 0);
  const Finished wrong =
      run({"b.toml", "--experiments", "drop", "--tube", "wood", "--pane", "wud"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("tube (--tube) of wood: none of the experiments has one"),
                               HasSubstr("add heap or fill to the experiments (--experiments)"),
                               HasSubstr("pane (--pane) is wud")));
}

TEST_F(NewCommand, ATubeThatGrainsJamInIsRefused) {
  EXPECT_THAT(run({"a.toml", "--grain-mm", "20,18,17", "--tube-mm", "50x150"}).err,
              HasSubstr("grains of 20 mm jam in it"));
  EXPECT_THAT(run({"a.toml", "--grains", "rapeseed", "--tube-mm", "300x900"}).err,
              HasSubstr("Rule: at most 100000"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(NewCommand, ATubeIsAskedForOnlyWhereThereIsOne) {
  const Finished drop = run({"a.toml", "--grain-mm", "0.1,0.1,0.1", "--experiments", "drop"});
  EXPECT_EQ(drop.exit_code, 0) << drop.err;
  ASSERT_EQ(run({"b.toml", "--experiments", "fill", "--tube-mm", "80x240"}).exit_code, 0);
  EXPECT_THAT(text("b.toml"), HasSubstr("[experiment.fill]\ntube_diameter_mm = 80\n"
                                        "tube_height_mm = 240\n"));
  EXPECT_THAT(run({"c.toml", "--experiments", "drop", "--tube-mm", "80x240"}).err,
              HasSubstr("none of the experiments has a tube"));
}

TEST_F(NewCommand, ChoicesThatMoveTheResultAreWritten) {
  ASSERT_EQ(run({"a.toml"}).exit_code, 0);
  EXPECT_THAT(text("a.toml"), AllOf(HasSubstr("\ndamping = \"per_contact\""),
                                    HasSubstr("\ndefinition = \"flank_20_80\"\n")));
}

TEST_F(NewCommand, NothingIsWrittenOver) {
  ASSERT_EQ(run({"a.toml"}).exit_code, 0);
  folder_.write("a/drops.csv", std::string("drop_mm,rebound_mm\n500,100\n"));
  folder_.write("a.toml", std::string("mine"));
  const Finished again = run({"a.toml"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.out, IsEmpty());
  EXPECT_THAT(again.err, AllOf(HasSubstr("repose: a.toml: already exists"),
                               HasSubstr("repose: a: already exists"), HasSubstr("Fix: ")));
  EXPECT_EQ(text("a.toml"), "mine");
  EXPECT_EQ(text("a/drops.csv"), "drop_mm,rebound_mm\n500,100\n");
  EXPECT_THAT(run({"none/b.toml"}).err, HasSubstr("there is no folder none"));
}

}  // namespace
}  // namespace repose::testing
