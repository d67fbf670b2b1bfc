// Particle files in `repose measure` and `repose render`.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"
#include "tests/support/particle_files.h"

namespace repose::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class MeasurePositions : public ::testing::Test {
 protected:
  MeasurePositions() {
    static const Spheres cone = packed_cone(27, .03, .002);
    folder_.write("heap.csv", particle_table(cone, {.header = "x [mm],y [mm],z [mm],radius [mm]\n",
                                                    .per_m = 1e3}));
    folder_.write("dump.9000", dump_step(0, moved(cone, {0, 0, .1})) + dump_step(9000, cone));
  }
  Finished run(const std::vector<std::string>& words) const { return run_repose(folder_, words); }
  std::string text(const std::string& name) const { return text_of(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(MeasurePositions, GivesTheKeysOfAPictureAndWhatTheViewsGave) {
  const Finished result = run({"measure", "heap.csv", "dump.9000", "--json", "out.json", "--csv",
                               "out.csv", "--overlay", "seen", "--threads", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("the plate found at"), HasSubstr("scatter by"),
                                HasSubstr("time step 9000 of 2"), HasSubstr("no sizes")));
  const json all = json::parse(text("out.json"));
  const json &table = all[0], &dump = all[1];
  EXPECT_NEAR(table["angle_deg"].get<double>(), 27, 1.5);
  EXPECT_NEAR(dump["angle_deg"].get<double>(), table["angle_deg"].get<double>(), .2);
  EXPECT_EQ(table["scale"], "positions");
  EXPECT_EQ(table["definition"], "flank_20_80");
  EXPECT_NEAR(table["height_mm"].get<double>(), 30, 3);
  EXPECT_TRUE(dump["height_mm"].is_null());
  EXPECT_EQ(table["positions"]["unit"], "mm");
  EXPECT_EQ(table["positions"]["views"].size(), 9U);
  EXPECT_EQ(table["positions"]["plate_from"], "found");
  EXPECT_TRUE(table["positions"]["between_views_deg"].is_number());
  EXPECT_EQ(dump["positions"]["step"], "9000");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "seen" / "heap.png"));
  const Finished again = run({"measure", "heap.csv", "dump.9000", "--json", "-", "--threads", "1"});
  EXPECT_EQ(again.out, text("out.json"));
}

TEST_F(MeasurePositions, AFolderOfParticlesIsItsFiles) {
  std::filesystem::create_directory(folder_.path() / "heaps");
  for (const char* name : {"heap.csv", "dump.9000"}) {
    std::filesystem::rename(folder_.path() / name, folder_.path() / "heaps" / name);
  }
  folder_.write("heaps/.hidden.csv", std::string("x\n"));
  const Finished result = run({"measure", "heaps", "--json", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json all = json::parse(result.out);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["file"], "heaps/dump.9000");
  const Finished both = run({"compare", "heaps", "heaps/heap.csv", "--json", "-"});
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_NEAR(json::parse(both.out)["angle_difference_deg"].get<double>(), 0, .5);
  std::filesystem::create_directory(folder_.path() / "none");
  EXPECT_THAT(run({"compare", "none", "heaps"}).err,
              AllOf(HasSubstr("no simulated heaps"), HasSubstr("files of particles")));
}

TEST_F(MeasurePositions, TheirAngleIsByTheDefinitionThatIsNamed) {
  const Finished usual = run({"measure", "heap.csv", "--json", "-"});
  const Finished named = run({"measure", "heap.csv", "--definition", "whole-flank", "--json", "-"});
  ASSERT_EQ(named.exit_code, 0) << named.err;
  const json heap = json::parse(named.out).at(0);
  EXPECT_EQ(heap["definition"], "whole_flank");
  EXPECT_EQ(heap["window"], json({0., 1.}));
  const json others = json::parse(usual.out).at(0)["definitions"];
  const auto same = std::ranges::find_if(
      others, [](const json& other) { return other["name"] == "whole_flank"; });
  ASSERT_NE(same, others.end());
  EXPECT_EQ(heap["angle_deg"], (*same)["angle_deg"]);
}

TEST_F(MeasurePositions, OptionsOfPicturesAndOfParticlesAreKeptApart) {
  EXPECT_THAT(run({"measure", "heap.csv", "--heap", "1,2,3,4"}).err,
              HasSubstr("--heap: is for pictures, and heap.csv is a file of particles"));
  EXPECT_THAT(run({"measure", "heap.png", "--unit", "mm"}).err,
              HasSubstr("--unit: is for scans and files of particles"));
  EXPECT_THAT(run({"measure", "heap.csv", "--unit", "m"}).err, HasSubstr("(--unit)"));
  EXPECT_THAT(run({"measure", "dump.9000", "--step", "5"}).err, HasSubstr("no time step 5"));
  EXPECT_THAT(run({"measure", "heap.csv", "--up", "up"}).err, HasSubstr("--up up"));
  EXPECT_THAT(run({"measure", "heap.csv", "--plate-height", "100"}).err,
              HasSubstr("below the plate"));
}

TEST_F(MeasurePositions, RenderDrawsThemAsStates) {
  const Finished table = run({"render", "heap.csv", "--out", "heap.png", "--truth", "heap.json"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.err, HasSubstr("the plate found at"));
  EXPECT_TRUE(json::parse(text("heap.json"))["ground_px"].is_array());
  EXPECT_THAT(run({"render", "dump.9000", "--out", "a.png"}).err,
              AllOf(HasSubstr("in which unit"), HasSubstr("(--unit)")));
  const Finished earlier = run(
      {"render", "dump.9000", "--unit", "m", "--step", "0", "--size", "320,180", "--out", "b.png"});
  EXPECT_EQ(earlier.exit_code, 0) << earlier.err;
  const Finished seen = run({"measure", "heap.png", "--json", "-"});
  EXPECT_NEAR(json::parse(seen.out)[0]["angle_deg"].get<double>(), 27, 1.5);
}

}  // namespace
}  // namespace repose::testing
