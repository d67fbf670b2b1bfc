#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/cli/command_test.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A folder with two drawn heaps, `steep.png` and `flat.png`, and `black.png` without one.
class Compare : public CommandTest {
 protected:
  Compare() : CommandTest({"compare"}) {
    static const vision::Picture steep = heap(0.5), flat = heap(0.35);
    vision::write_picture(path("steep.png"), steep);
    vision::write_picture(path("flat.png"), flat);
    vision::write_picture(
        path("black.png"),
        {.width = 200, .height = 200, .bgr = std::vector<std::uint8_t>(120000, 0)});
  }
  static vision::Picture heap(double angle_rad) {
    HeapScene scene;
    scene.width = 600;
    scene.height = 400;
    scene.form.left_rad = angle_rad;
    scene.form.right_rad = angle_rad;
    return draw_heap(scene).picture;
  }
};

TEST_F(Compare, TwoHeapsGiveNumbersAndAVerdict) {
  const Finished done = run({"steep.png", "flat.png"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.err, IsEmpty());
  EXPECT_THAT(done.out, AllOf(HasSubstr("steep.png"), HasSubstr("flat.png"), HasSubstr("IoU"),
                              HasSubstr("different: "), HasSubstr("Without a scale")));
  std::istringstream lines(done.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 90U) << line;
}

TEST_F(Compare, JsonHasTheContractsKeys) {
  const Finished done = run({"steep.png", "flat.png", "--json", "-"});
  EXPECT_EQ(done.exit_code, 0);
  const json object = json::parse(done.out);
  for (const char* key : {"iou", "profile_rmse", "unit", "angle_difference_deg",
                          "angle_difference_interval", "verdict"}) {
    EXPECT_TRUE(object.contains(key)) << key;
  }
  EXPECT_EQ(object["unit"], "root_area");
  EXPECT_EQ(object["verdict"], "different");
  EXPECT_NEAR(object["angle_difference_deg"], (0.5 - 0.35) * 180 / 3.14159265, 1.0);
  const json& interval = object["angle_difference_interval"];
  EXPECT_LT(interval[0], object["angle_difference_deg"]);
  EXPECT_GT(interval[1], object["angle_difference_deg"]);
  EXPECT_TRUE(object["profile_mean"].is_null()) << "it does not exist without a scale";
  EXPECT_TRUE(object["profile_rmse_grains"].is_null());
}

TEST_F(Compare, BothAnglesAreByTheDefinitionThatIsNamed) {
  const Finished usual = run({"steep.png", "flat.png", "--json", "-"});
  EXPECT_EQ(json::parse(usual.out)["definition"], "flank_20_80");
  const Finished named =
      run({"steep.png", "flat.png", "--definition", "whole_flank", "--json", "named.json"});
  EXPECT_THAT(named.out, HasSubstr("all angles by whole_flank"));
  const json object = json::parse(text_of(path("named.json")));
  EXPECT_EQ(object["definition"], "whole_flank");
  EXPECT_NE(object["angle_deg"], json::parse(usual.out)["angle_deg"]);
}

TEST_F(Compare, OneFileTwiceIsEquivalentWithoutError) {
  const json same = result({"steep.png", "./steep.png"});
  EXPECT_EQ(same["iou"], 1);
  EXPECT_EQ(same["profile_rmse"], 0);
  EXPECT_EQ(same["angle_difference_interval"], json({0.0, 0.0}));
  EXPECT_EQ(same["verdict"], "equivalent");
  EXPECT_TRUE(std::any_of(same["warnings"].begin(), same["warnings"].end(),
                          [](const json& warning) { return warning["code"] == "same_picture"; }));
}

TEST_F(Compare, OneFileMeasuredInTwoWaysHasErrors) {
  const json unlike = result({"steep.png", "steep.png", "--exclude-second", "0,0,40,40"});
  EXPECT_LT(unlike["angle_difference_interval"][0], unlike["angle_difference_interval"][1]);
}

TEST_F(Compare, TheMarginDecidesWhatIsEquivalent) {
  EXPECT_EQ(result({"steep.png", "flat.png", "--margin-deg", "15"})["verdict"], "equivalent");
  EXPECT_EQ(result({"steep.png", "flat.png"})["margin_deg"], 2);
}

TEST_F(Compare, ScalesGiveMillimetres) {
  const json mm = result({"steep.png", "flat.png", "--mm-per-px", "0.5,0.25", "--grain-mm", "4"});
  EXPECT_EQ(mm["unit"], "mm");
  EXPECT_NEAR(mm["base"][0], 2 * mm["base"][1].get<double>(), 3);
  EXPECT_NEAR(mm["profile_rmse_grains"], mm["profile_rmse"].get<double>() / 4, 1e-9);
  const json base = result({"steep.png", "flat.png", "--base-mm", "180"});
  EXPECT_NEAR(base["base"][0], 180, 1e-6);
  EXPECT_NEAR(base["base_difference"], 0, 1e-6);
}

TEST_F(Compare, ScalesSavedBesideThePicturesGiveMillimetres) {
  std::ofstream(path("steep.png.repose.toml")) << "scale = [100, 350, 500, 350, 200]\n";
  EXPECT_NE(result({"steep.png", "flat.png"})["unit"], "mm") << "one scale is not enough";
  std::ofstream(path("flat.png.repose.toml")) << "scale = [100, 350, 500, 350, 100]\n";
  const json mm = result({"steep.png", "flat.png", "--grain-mm", "4"});
  EXPECT_EQ(mm["unit"], "mm");
  EXPECT_NEAR(mm["base"][0], 2 * mm["base"][1].get<double>(), 3);
  EXPECT_TRUE(mm["profile_rmse_grains"].is_number());
  const json given = result({"steep.png", "flat.png", "--mm-per-px", "0.5"});
  EXPECT_NEAR(given["base"][0], given["base"][1], 3) << "what is typed stands above what is saved";
}

TEST_F(Compare, UnmeasurablePicturesAreRefusedWithTheReason) {
  const Finished done = run({"steep.png", "black.png", "--json", "-", "--overlay", "both.png"});
  EXPECT_EQ(done.exit_code, 3);
  const json object = json::parse(done.out);
  EXPECT_EQ(object["status"], "refused");
  EXPECT_THAT(object["reason"], HasSubstr("second picture: "));
  EXPECT_EQ(object["verdict"], "cannot tell");
  for (const char* key :
       {"iou", "profile_rmse", "unit", "angle_difference_deg", "angle_difference_interval"}) {
    EXPECT_TRUE(object[key].is_null()) << key;
  }
  EXPECT_FALSE(exists("both.png"));
  EXPECT_THAT(done.err, HasSubstr("both.png: not drawn"));
  EXPECT_THAT(run({"steep.png", "black.png"}).out, HasSubstr("refused: second picture: "));
}

TEST_F(Compare, ForeignAndMissingFilesAreNamedTogether) {
  folder_.write("notes.jpg", std::string("angle: 23 degrees"));
  const Finished done = run({"notes.jpg", "missing.png", "--json", "-"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(done.err, AllOf(HasSubstr("notes.jpg: no picture"),
                              HasSubstr("missing.png: there is no such file")));
}

TEST_F(Compare, OverlayAndJsonAreWritten) {
  const Finished done =
      run({"steep.png", "flat.png", "--overlay", "both.png", "--json", "both.json"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(vision::read_picture(path("both.png")).width, 1400);
  EXPECT_EQ(json::parse(text("both.json"))["verdict"], "different");
  EXPECT_THAT(done.out, HasSubstr("different"));
}

TEST_F(Compare, PlacesThatCannotBeWrittenAreErrorsBeforeTheWork) {
  const Finished done = run({"steep.png", "flat.png", "--overlay", "no/such/folder/x.png", "--json",
                             "no/such/folder/x.json"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("--overlay no/such"), HasSubstr("--json no/such")));
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(run({"steep.png", "flat.png", "--overlay", "flat.png"}).err,
              HasSubstr("would overwrite an input file"));
  EXPECT_THAT(run({"steep.png", "flat.png", "--overlay", "x.png", "--json", "x.png"}).err,
              HasSubstr("both write to x.png"));
  EXPECT_THAT(run({"steep.png", "flat.png", "--overlay", "-"}).err, HasSubstr("--overlay -: "));
}

TEST_F(Compare, WrongOptionsAreNamedTogether) {
  const Finished done =
      run({"steep.png", "flat.png", "--mm-per-px", "0.5,", "--base-mm", "-3", "--margin-deg", "0",
           "--grain-mm", "x", "--pitch-deg", "1,60", "--exclude-second", "1,2", "--window", "1"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err,
              AllOf(HasSubstr("--mm-per-px 0.5,"), HasSubstr("--base-mm -3"),
                    HasSubstr("both give the scale"), HasSubstr("margin (--margin-deg) = 0"),
                    HasSubstr("--grain-mm x"), HasSubstr("(--pitch-deg) = 60"),
                    HasSubstr("--exclude-second 1,2"), HasSubstr("--window 1")));
  EXPECT_THAT(run({"steep.png", "flat.png", "--grain-mm", "4"}).err, HasSubstr("need a scale"));
}

TEST_F(Compare, OneOrThreePicturesAreTooFewOrTooMany) {
  for (const Words& words :
       {Words{}, Words{"steep.png"}, Words{"steep.png", "flat.png", "x.png"}}) {
    const Finished done = run(words);
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_THAT(done.err, AllOf(HasSubstr("Fix: "), Not(HasSubstr("internal"))));
  }
}

}  // namespace
}  // namespace repose::testing
