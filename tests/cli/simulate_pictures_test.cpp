#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"
#include "tests/support/soft_study.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A heap of soft, rough grains, five grains high: takes a few seconds.
const std::string kPicturedStudy = kSoftBalls + kRoughContacts + R"([experiment.drop]
height_mm = 50
grains = 2
[experiment.heap]
grains = 240
lift_speed_mm_s = 120
)";

/// All tests share one heap: commands reuse it from `runs` and only take pictures.
class SimulatePictures : public CommandTest {
 protected:
  SimulatePictures() : CommandTest({"simulate", "heap", "study.toml"}) {
    folder_.write("study.toml", kPicturedStudy);
    std::filesystem::copy(heap_->path() / "runs", path("runs"),
                          std::filesystem::copy_options::recursive);
  }

  static void SetUpTestSuite() {
    heap_ = std::make_unique<TemporaryFolder>();
    heap_->write("study.toml", kPicturedStudy);
    const Finished made =
        run_repose(*heap_, {"simulate", "heap", "study.toml", "--views", "0", "--out", "runs"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() { heap_.reset(); }

  /// A folder with the same runs, for a study that evaluates them differently.
  void add_store(Words& words, const std::string& name) const {
    std::filesystem::create_directory(path(name));
    std::filesystem::copy(heap_->path() / "runs" / "runs", path(name) / "runs");
    words.insert(words.end(), {"--out", name});
  }

  static double stored_wall_s() {
    return json::parse(text_of(heap_->path() / "runs/result.json"))["repeats"][0]["wall_s"];
  }

  json timeless(Words words) const {
    words.insert(words.end(), {"--out", "runs"});
    return without_times(result(words));
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> heap_;
};

TEST_F(SimulatePictures, TheValueIsTheMeanOfWhatThePicturesShow) {
  const json heap = timeless({"--views", "4", "--threads", "1"});
  const json& repeat = heap["repeats"][0];
  EXPECT_EQ(heap["source"], "pictures");
  ASSERT_EQ(repeat["views"].size(), 4U);
  double sum = 0;
  int measured = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const json& view = repeat["views"][k];
    EXPECT_NEAR(view["azimuth_deg"].get<double>(), 45.0 * static_cast<double>(k), 1e-5);
    EXPECT_EQ(view["angle_deg"].is_null(), view["status"] == "refused");
    if (view["angle_deg"].is_null()) continue;
    sum += view["angle_deg"].get<double>();
    ++measured;
  }
  ASSERT_GE(measured, 2);
  EXPECT_NEAR(heap["value"].get<double>(), sum / measured, 1e-5);
  EXPECT_EQ(heap["value"], heap["angle_from_pictures_deg"]);
  EXPECT_EQ(repeat["value"], heap["value"]);
  EXPECT_EQ(heap["views"], 4);
  EXPECT_EQ(heap["views_refused"], 4 - measured);
  EXPECT_GT(heap["sd_between_views_deg"], 0);
  // Single views of such a low heap are up to 4 degrees off the same view of the positions.
  EXPECT_NEAR(heap["value"].get<double>(), heap["angle_from_positions_deg"].get<double>(), 3.0);

  const auto overlay = path("runs/heap_seed_1.overlay.png");
  EXPECT_EQ(repeat["overlay"], "runs/heap_seed_1.overlay.png");
  EXPECT_FALSE(vision::read_picture(overlay).empty());

  EXPECT_EQ(timeless({"--views", "4", "--threads", "3"}), heap) << "threads do not change it";
}

/// Two boxes with the same grains.
class SimulateDrawDown : public CommandTest {
 protected:
  SimulateDrawDown() : CommandTest({"simulate", "draw_down", "study.toml", "--out", "runs"}) {
    folder_.write("study.toml", kPicturedStudy + R"([experiment.draw_down]
length_mm = 350
depth_mm = 92
slot_mm = 160
fill_mm = 92
drop_mm = 175
)");
  }
};

TEST_F(SimulateDrawDown, LeavesThePictureInWhichItsAnglesAreMeasured) {
  const json repeat = result({"--seed", "8"})["repeats"][0];
  EXPECT_GT(repeat["readings"]["upper_angle_deg"].get<double>(), 20);
  EXPECT_GT(repeat["readings"]["lower_angle_deg"].get<double>(), 10);
  EXPECT_EQ(repeat["overlay"], "runs/draw_down_seed_8.overlay.png");
  EXPECT_GT(vision::read_picture(path("runs/draw_down_seed_8.overlay.png")).width, 350);
  EXPECT_EQ(result({"--seed", "8"})["repeats"][0]["readings"], repeat["readings"])
      << "from the folder";
}

TEST_F(SimulatePictures, NoPicturesLeaveTheAngleOfThePositions) {
  const json none = timeless({"--views", "0"});
  EXPECT_FALSE(none.contains("source"));
  EXPECT_FALSE(none["repeats"][0].contains("views"));
  EXPECT_FALSE(exists("runs/heap_seed_1.overlay.png"));

  const json two = timeless({"--views", "2"});
  EXPECT_EQ(two["angle_from_positions_deg"], none["value"]);
  const json view = two["repeats"][0]["views"][1];
  EXPECT_EQ(view["azimuth_deg"], 90);

  // The other two commands give the same from the state, in a picture of another size.
  const Words render = {"render", "runs/heap_seed_1.vtp", "--view", "90", "--out", "side.png"};
  ASSERT_EQ(run_repose(folder_, render).exit_code, 0);
  const Finished measured = run_repose(folder_, {"measure", "side.png", "--json", "-"});
  const json picture = json::parse(measured.out)[0];
  ASSERT_FALSE(view["angle_deg"].is_null());
  ASSERT_FALSE(picture["angle_deg"].is_null()) << picture;
  EXPECT_NEAR(view["angle_deg"].get<double>(), picture["angle_deg"].get<double>(), .5);

  EXPECT_THAT(run({"--out", "runs", "--views", "1"}).out,
              AllOf(HasSubstr("the value"), HasSubstr("positions"), HasSubstr("1 picture: ")));
}

TEST_F(SimulatePictures, ACameraOverThePlateIsRefused) {
  const Finished over = run({"--set", "experiment.heap.camera_distance_mm=100"});
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_THAT(over.err, AllOf(HasSubstr("heap.camera_distance_m is 0.1, heap.plate_m 0.4"),
                              HasSubstr("Fix: ")));
  const Finished alone = run({"--set", "experiment.heap.camera_height_mm=40"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, AllOf(HasSubstr("camera_height_mm"), HasSubstr("camera_distance_mm")));
}

TEST_F(SimulatePictures, AResultSaysWhereItsHeapsWereSeenFrom) {
  EXPECT_TRUE(timeless({"--views", "1"})["camera_mm"].is_null());
  Words words = {"--views", "1",        "--set", "experiment.heap.camera_distance_mm=600",
                 "--json",  "near.json"};
  add_store(words, "near");
  EXPECT_THAT(run(words).out, HasSubstr("600 mm from the heap's middle, 40 mm above the plate"));
  EXPECT_EQ(json::parse(text("near.json"))["camera_mm"], json({600, 40}));
}

TEST_F(SimulatePictures, AnotherDefinitionReadsTheSameRun) {
  const json usual = timeless({"--views", "4"});
  EXPECT_EQ(usual["definition"], "flank_20_80");
  EXPECT_EQ(usual["value"], usual["definitions_deg"]["flank_20_80"]);
  const json of_positions = timeless({"--views", "0"});
  Words words = {"--set", "experiment.heap.definition=\"whole_flank\"", "--json", "whole.json"};
  add_store(words, "whole");
  for (const auto& [views, by_usual] : {std::pair("4", usual), {"0", of_positions}}) {
    Words of_views = words;
    of_views.insert(of_views.end(), {"--views", views});
    const Finished finished = run(of_views);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const json whole = json::parse(text("whole.json"));
    EXPECT_EQ(whole["definition"], "whole_flank");
    EXPECT_EQ(whole["value"], by_usual["definitions_deg"]["whole_flank"]);
    EXPECT_NE(whole["value"], by_usual["value"]);
    EXPECT_EQ(whole["definitions_deg"], by_usual["definitions_deg"]);
    EXPECT_EQ(whole["repeats"][0]["readings"], by_usual["repeats"][0]["readings"]);
    EXPECT_EQ(whole["repeats"][0]["wall_s"], stored_wall_s()) << "not simulated again";
    EXPECT_THAT(finished.out, HasSubstr("the value  least-squares line from toe"));
  }
}

TEST_F(SimulatePictures, AnAngleOfUnknownDefinitionIsWarnedOf) {
  Words words = {"--views", "1", "--set", "experiment.heap.measured={mean=25}", "--json", "-"};
  add_store(words, "told");
  const json heap = json::parse(run(words).out);
  std::string message;
  for (const json& warning : heap["warnings"]) {
    if (warning["code"] == "assumed_definition") message = warning["message"];
  }
  EXPECT_THAT(message, AllOf(HasSubstr("flank_20_80 is assumed"), HasSubstr("whole_flank"),
                             HasSubstr("Fix: definition = ")));
}

TEST_F(SimulatePictures, ALayerIsNoReading) {
  const Finished finished = run({"--set", "experiment.heap.grains=12", "--views", "4", "--repeats",
                                 "2", "--json", "-", "--out", "layer"});
  EXPECT_EQ(finished.exit_code, 3) << finished.err;
  EXPECT_THAT(finished.err,
              AllOf(HasSubstr("seed 1: heap: the grains spread to a layer"),
                    HasSubstr("seed 2: heap: "), HasSubstr("Fix: "),
                    HasSubstr("repose render layer/heap_seed_1.vtp"), HasSubstr("no result")));
  const json layer = json::parse(finished.out);
  EXPECT_TRUE(layer["value"].is_null());
  EXPECT_TRUE(layer["interval"].is_null());
  ASSERT_EQ(layer["repeats"].size(), 2U);
  const json& repeat = layer["repeats"][0];
  EXPECT_TRUE(repeat["value"].is_null());
  EXPECT_THAT(repeat["reason"].get<std::string>(), HasSubstr("spread to a layer"));
  EXPECT_TRUE(repeat["readings"]["angle_xz_deg"].is_null());
  EXPECT_GT(repeat["readings"]["height_mm"], 5);
  EXPECT_TRUE(exists("layer/heap_seed_1.vtp"));
  EXPECT_FALSE(exists("layer/result.json"));
}

TEST_F(SimulatePictures, NumbersOfViewsThatMakeNoSenseAreRefused) {
  for (const char* views : {"-1", "1.5", "x", "361"}) {
    const Finished finished = run({"--views", views});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_THAT(finished.err,
                AllOf(HasSubstr("--views " + std::string(views)), HasSubstr("Fix: ")));
  }
  const Finished drop = run_repose(folder_, {"simulate", "drop", "study.toml", "--views", "3"});
  EXPECT_EQ(drop.exit_code, 2);
  EXPECT_THAT(drop.err, HasSubstr("only heaps are measured in pictures"));
}

}  // namespace
}  // namespace repose::testing
