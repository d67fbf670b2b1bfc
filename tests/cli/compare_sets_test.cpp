#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"
#include "tests/support/heap_picture.h"
#include "tests/support/soft_study.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A heap four grains high that is poured within seconds.
const std::string kComparedStudy = kSoftBalls + kRoughContacts + R"([experiment.heap]
grains = 160
lift_speed_mm_s = 150
)";

/// Folders of drawn heaps: `flat`, `flat_again` and `steep`, three in each.
class CompareOfSets : public CommandTest {
 protected:
  CompareOfSets() : CommandTest({"compare"}) {
    draw("flat", 0.35);
    draw("flat_again", 0.352);
    draw("steep", 0.5);
  }

 private:
  void draw(const std::string& name, double angle_rad) const {
    std::filesystem::create_directories(path(name));
    int number = 0;
    for (const double step : {-0.005, 0.0, 0.005}) {
      HeapScene scene;
      scene.width = 600;
      scene.height = 400;
      scene.form.left_rad = angle_rad + step;
      scene.form.right_rad = angle_rad + step;
      vision::write_picture(path(name) / (std::to_string(++number) + ".png"),
                            draw_heap(scene).picture);
    }
  }
};

TEST_F(CompareOfSets, CopiesAreCountedOnceAndASetAgainstItselfSaysSo) {
  std::filesystem::copy(path("flat"), path("twice"));
  std::filesystem::copy(path("flat/1.png"), path("twice/copy.png"));
  const Finished done = run({"twice", "flat", "--json", "-"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("twice/copy.png: the same picture as twice/1.png, counted once"));
  const json compared = json::parse(done.out);
  EXPECT_EQ(compared["sets"][0]["n"], 3);
  EXPECT_THAT(compared["warnings"].dump(), HasSubstr("same_heaps"));
  EXPECT_THAT(run({"twice", "flat"}).out, HasSubstr("a set is compared with itself"));
  std::filesystem::copy(path("steep/1.png"), path("twice/other.png"));
  EXPECT_THAT(run({"twice", "flat"}).out, HasSubstr("3 of the heaps are in both sets"));
  EXPECT_THAT(result({"flat", "steep"})["warnings"].dump(), Not(HasSubstr("same_heaps")));
}

TEST_F(CompareOfSets, FoldersAreComparedByTheirMeans) {
  const Finished done = run({"flat", "flat_again", "--overlay", "both.png"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.err, IsEmpty());
  EXPECT_THAT(done.out, AllOf(HasSubstr("3 of 3"), HasSubstr("equivalent: the means"),
                              HasSubstr("Mean outlines")));
  EXPECT_LE(longest_line(done.out), 90U);
  EXPECT_EQ(vision::read_picture(path("both.png")).width, 1400);
  EXPECT_EQ(result({"flat", "steep"})["verdict"], "different");
}

TEST_F(CompareOfSets, JsonHoldsEveryHeap) {
  const json sets = result({"flat", "steep/1.png"});
  EXPECT_EQ(sets["sets"][0]["n"], 3);
  EXPECT_EQ(sets["sets"][0]["heaps"][2]["file"], "flat/3.png");
  EXPECT_EQ(sets["sets"][1]["n"], 1);
  EXPECT_TRUE(sets["sets"][1]["sd_deg"].is_null());
  EXPECT_EQ(sets["warnings"][0]["code"], "one_heap");
}

TEST_F(CompareOfSets, PicturesThatDifferInANumberAreOfOneHeapWhenAsked) {
  std::filesystem::create_directories(path("grouped"));
  std::filesystem::copy(path("flat/1.png"), path("grouped/a_1.png"));
  std::filesystem::copy(path("flat/2.png"), path("grouped/a_2.png"));
  std::filesystem::copy(path("flat/3.png"), path("grouped/b_1.png"));
  const json sets = result({"grouped", "steep", "--group-by-name"});
  EXPECT_EQ(sets["sets"][0]["n"], 2);
  EXPECT_EQ(sets["sets"][0]["heaps"][0]["files"], json({"grouped/a_1.png", "grouped/a_2.png"}));
  EXPECT_EQ(sets["sets"][0]["heaps"][0]["pictures"].size(), 2U);
  EXPECT_EQ(sets["sets"][1]["n"], 3) << "these have no _ or -";
  EXPECT_EQ(result({"grouped", "steep"})["sets"][0]["n"], 3);
  EXPECT_THAT(run({"grouped", "steep", "--group-by-name"}).out, HasSubstr("3 pictures of 2 heaps"));
  const Finished pair = run({"flat/1.png", "steep/1.png", "--group-by-name"});
  EXPECT_EQ(pair.exit_code, 2);
  EXPECT_THAT(pair.err, HasSubstr("there is no folder of photographs"));
}

TEST_F(CompareOfSets, ASimulatedSetIsSeenFromAllAround) {
  folder_.write("study.toml", kComparedStudy);
  ASSERT_EQ(run_repose(folder_, {"simulate", "heap", "study.toml", "--repeats", "2", "--views", "2",
                                 "--out", "heaps"})
                .exit_code,
            0);
  const Finished done =
      run({"flat", "heaps", "--mm-per-px", "0.5", "--camera-mm", "500,40", "--json", "sets.json"});
  const json sets = json::parse(text("sets.json"));
  EXPECT_EQ(sets["sets"][1]["heaps"].size(), 2U) << done.err;
  EXPECT_EQ(sets["sets"][1]["heaps"][0]["pictures"].size(), 9U);
  EXPECT_EQ(sets["camera_mm"], json({500, 40}));
  EXPECT_THAT(done.out, AllOf(HasSubstr("simulated heaps, 9 views of each"),
                              HasSubstr("500 mm away and 40 mm")));
  const Finished wrong =
      run({"flat", "heaps", "--mm-per-px", "1,2", "--exclude-second", "0,0,9,9", "--base-mm", "9"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("--mm-per-px: heaps is simulated"),
                               HasSubstr("--exclude-second: heaps is simulated"),
                               HasSubstr("--base-mm is the base of one heap")));
}

TEST_F(CompareOfSets, ACameraIsForSimulatedHeapsAndHasTwoLengths) {
  folder_.write("heap.vtp", std::string("is not read before the options are right"));
  for (const char* wrong : {"500", "500,0", "-1,40", "500,40,1", "far,40", "nan,40", "40,500"}) {
    const Finished refused = run({"flat", "heap.vtp", "--camera-mm", wrong});
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--camera-mm"), HasSubstr("Fix: "))) << wrong;
  }
  EXPECT_THAT(run({"flat", "steep", "--camera-mm", "500,40"}).err,
              HasSubstr("for simulated heaps"));
  EXPECT_TRUE(result({"flat", "steep"})["camera_mm"].is_null());
}

TEST_F(CompareOfSets, AFolderWithoutHeapsIsRefused) {
  std::filesystem::create_directories(path("empty"));
  const Finished done = run({"flat", "empty"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("empty: no pictures, no scans and no simulated heaps"),
                              HasSubstr("Fix: "), Not(HasSubstr("flat:"))));
}

TEST_F(CompareOfSets, APictureWithoutAHeapIsLeftOutWithItsReason) {
  vision::write_picture(path("flat") / "black.png",
                        {.width = 200, .height = 200, .bgr = std::vector<std::uint8_t>(120000, 0)});
  const Finished done = run({"flat", "steep"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.out, AllOf(HasSubstr("3 of 4"), HasSubstr("flat/black.png: ")));
}

TEST_F(CompareOfSets, WhatIsNoStateIsNamed) {
  folder_.write("heap.vtp", std::string("no state"));
  const Finished done = run({"flat", "heap.vtp"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("heap.vtp"), HasSubstr("Fix: ")));
}

}  // namespace
}  // namespace repose::testing
