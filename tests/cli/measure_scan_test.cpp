#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"
#include "tests/support/drawn_scan.h"
#include "tests/support/heap_picture.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A folder with a scan of a cone of 27 degrees, 80 mm high.
class MeasureScan : public ::testing::Test {
 protected:
  MeasureScan() {
    folder_.write("heap.ply", ply_of(drawn_scan({.surface = cone_surface(27, 80)})));
  }
  Finished run(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"measure"};
    all.insert(all.end(), words.begin(), words.end());
    return run_repose(folder_, all);
  }

  TemporaryFolder folder_;
};

TEST_F(MeasureScan, GivesTheKeysOfAPictureAndItsOwn) {
  const Finished result = run({"heap.ply", "--unit", "mm", "--json", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json heap = json::parse(result.out).at(0);
  EXPECT_EQ(heap["status"], "ok");
  EXPECT_EQ(heap["definition"], "flank_20_80");
  EXPECT_NEAR(heap["angle_deg"].get<double>(), 27, heap["uncertainty_deg"].get<double>());
  EXPECT_TRUE(heap["left"].is_null() && heap["confidence"].is_null());
  EXPECT_NEAR(heap["volume_ml"].get<double>(), cone_volume(27, 80) / 1000,
              heap["volume_ml_uncertainty"].get<double>());
  EXPECT_TRUE(heap["cone_volume_ml"].is_null());
  EXPECT_EQ(heap["scan"]["azimuths"].size(), 72U);
  EXPECT_EQ(heap["scan"]["points"], 100'000);
  EXPECT_EQ(heap["scan"]["ground"]["sectors"], 8);
  const json& silhouettes = heap["scan"]["silhouettes"];
  EXPECT_EQ(silhouettes["status"], "ok");
  EXPECT_NEAR(silhouettes["angle_deg"].get<double>(), 27,
              silhouettes["uncertainty_deg"].get<double>());
}

TEST_F(MeasureScan, TellsItsSizesAndWhyThereAreNone) {
  EXPECT_THAT(run({"heap.ply", "--unit", "mm"}).out,
              AllOf(HasSubstr("72 azimuths"), HasSubstr("in silhouette from 9 sides"),
                    HasSubstr("volume "), HasSubstr(" ml")));
  EXPECT_THAT(run({"heap.ply"}).out, AllOf(HasSubstr("no sizes"), HasSubstr("(--unit")));
}

TEST_F(MeasureScan, OfSeveralTheMeanInSilhouetteIsBeside) {
  folder_.write("other.ply", ply_of(drawn_scan({.surface = cone_surface(26, 80), .seed = 3})));
  const Finished scans = run({"heap.ply", "other.ply", "--unit", "mm", "--summary", "mean.json"});
  ASSERT_EQ(scans.exit_code, 0) << scans.err;
  EXPECT_THAT(scans.out, HasSubstr("of the scans in silhouette, as compare and studies take them"));
  const json summary = json::parse(text_of(folder_.path() / "mean.json"));
  EXPECT_EQ(summary["scans"], 2);
  EXPECT_EQ(summary["silhouettes"]["n"], 2);
  EXPECT_NEAR(summary["silhouettes"]["mean_deg"].get<double>(), 26.5, .3);
  HeapScene scene;
  scene.width = 600;
  scene.height = 400;
  vision::write_picture(folder_.path() / "photo.png", draw_heap(scene).picture);
  EXPECT_THAT(run({"heap.ply", "photo.png"}).out, HasSubstr("do not mix them"));
}

TEST_F(MeasureScan, DrawsAnOverlayAndWritesARowAndAPage) {
  const Finished result = run(
      {"heap.ply", "--unit", "mm", "--overlay", "o", "--csv", "a.csv", "--report", "page.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(vision::read_picture(folder_.path() / "o" / "heap.png").width, 1000);
  const std::string csv = text_of(folder_.path() / "a.csv");
  EXPECT_THAT(csv, AllOf(HasSubstr("volume_ml"), HasSubstr(",72,")));
  EXPECT_THAT(text_of(folder_.path() / "page.html"), HasSubstr("heap.ply"));
}

TEST_F(MeasureScan, InAFolderItsTextureIsNoHeap) {
  vision::write_picture(
      folder_.path() / "heap.png",
      {.width = 40, .height = 40, .bgr = std::vector<std::uint8_t>(std::size_t{3} * 1600, 99)});
  const Finished result = run({".", "--json", "-"});
  EXPECT_EQ(json::parse(result.out).size(), 1U);
  EXPECT_THAT(result.err, AllOf(HasSubstr("heap.png: left out"), HasSubstr("a scan has its name")));
}

TEST_F(MeasureScan, OptionsThatSayNothingAreRefused) {
  const Finished of_scan = run({"heap.ply", "--heap", "1,2,3,4", "--method", "paper", "--unit",
                                "miles", "--ground-plane", "1,2,3"});
  EXPECT_EQ(of_scan.exit_code, 2);
  EXPECT_THAT(of_scan.err, AllOf(HasSubstr("--heap: is for pictures, and heap.ply is a scan"),
                                 HasSubstr("--method paper"), HasSubstr("--unit miles"),
                                 HasSubstr("--ground-plane 1,2,3")));
  const Finished of_picture = run({"heap.png", "--unit", "mm"});
  EXPECT_EQ(of_picture.exit_code, 2);
  EXPECT_THAT(of_picture.err, HasSubstr("--unit: is for scans and files of particles"));
}

TEST_F(MeasureScan, DamagedFilesAreNamedWithARemedy) {
  folder_.write("cut.ply", text_of(folder_.path() / "heap.ply").substr(0, 5000));
  const Finished result = run({"cut.ply"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(HasSubstr("cut.ply"), HasSubstr("too soon"), HasSubstr("Fix: ")));
}

/// Simulated heaps are measured as silhouettes, which show a different angle.
TEST_F(MeasureScan, AStudyTakesNoScans) {
  const std::string study = text_of(source_folder() / "samples/hazelnut/study.toml");
  const std::string known = "measured = { mean = 23.38, sd = 0.72, n = 10 }";
  const std::size_t at = study.find(known);
  ASSERT_NE(at, std::string::npos);
  folder_.write("study.toml", study.substr(0, at) + "measured = { pictures = [\"heap.ply\"] }" +
                                  study.substr(at + known.size()));
  const Finished result = run_repose(folder_, {"calibrate", "study.toml", "--dry-run"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("heap.ply"), HasSubstr("three-dimensional scan")));
}

}  // namespace
}  // namespace repose::testing
