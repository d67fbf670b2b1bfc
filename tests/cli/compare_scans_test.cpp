#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"
#include "tests/support/drawn_scan.h"
#include "tests/support/heap_picture.h"
#include "tests/support/particle_files.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Scans and particles of round heaps, and a picture of a heap of 27 degrees.
class CompareScans : public CommandTest {
 protected:
  CompareScans() : CommandTest({"compare"}) {
    for (const auto& [name, angle_deg] :
         {std::pair{"scans/a.ply", 27.0}, std::pair{"scans/b.ply", 26.5}}) {
      std::filesystem::create_directories(path("scans"));
      folder_.write(name, ply_of(drawn_scan({.surface = cone_surface(angle_deg, 80)})));
    }
    HeapScene scene;
    scene.width = 600;
    scene.height = 400;
    constexpr double kSame_rad = 27 * 3.14159265358979 / 180;
    scene.form.left_rad = kSame_rad;
    scene.form.right_rad = kSame_rad;
    vision::write_picture(path("photo.png"), draw_heap(scene).picture);
  }
};

TEST_F(CompareScans, APictureAndAScanOfOneKindOfHeapAgree) {
  const Finished done =
      run({"photo.png", "scans/a.ply", "--overlay", "both.png", "--json", "o.json"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("equivalent"));
  const json compared = json::parse(text("o.json"));
  EXPECT_EQ(compared["verdict"], "equivalent");
  EXPECT_GT(compared["iou"], .95);
  EXPECT_THAT(compared["warnings"].dump(), HasSubstr("views_scatter"));
  EXPECT_TRUE(std::filesystem::exists(path("both.png")));
}

TEST_F(CompareScans, OfTwoScansTheirSilhouettesAreCompared) {
  const json compared = result({"scans/a.ply", "scans/b.ply"});
  EXPECT_NEAR(compared["angle_difference_deg"].get<double>(), .5, .2);
  EXPECT_EQ(compared["verdict"], "equivalent");
  // It is unknown which side of one heap corresponds to which of the other.
  const json& left = compared["left"]["angle_difference_interval"];
  const json& all = compared["angle_difference_interval"];
  EXPECT_GT(left[1].get<double>() - left[0].get<double>(),
            all[1].get<double>() - all[0].get<double>());
  const json same = result({"scans/a.ply", "scans/a.ply"});
  EXPECT_EQ(same["angle_difference_deg"], 0);
}

TEST_F(CompareScans, AFolderOfThemIsASetOfHeaps) {
  std::filesystem::create_directories(path("photos"));
  std::filesystem::copy(path("photo.png"), path("photos/1.png"));
  const Finished done = run({"photos", "scans"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("scans: scanned heaps, 9 views of each"),
                              HasSubstr("2 of 2"), HasSubstr("Mean outlines")));
}

TEST_F(CompareScans, ParticlesOfAnotherProgramAreASimulatedHeap) {
  folder_.write("heap.csv",
                particle_table(packed_cone(27, .06, .0025), {.header = "x_m,y_m,z_m,radius_m\n"}));
  const Finished done = run({"heap.csv", "scans"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("heap.csv: simulated heaps"), HasSubstr("1 of 1")));
}

TEST_F(CompareScans, RefusedOnesSayWhyOnce) {
  folder_.write("scans/flat.ply",
                ply_of(drawn_scan({.surface = [](double, double) { return 0.; }})));
  const Finished pair = run({"photo.png", "scans/flat.ply"});
  EXPECT_EQ(pair.exit_code, 3);
  EXPECT_THAT(pair.out, HasSubstr("refused: second picture: "));
  const Finished sets = run({"scans", "photo.png"});
  EXPECT_EQ(sets.exit_code, 0) << sets.err;
  const std::size_t first = sets.out.find("! scans/flat.ply: ");
  ASSERT_NE(first, std::string::npos) << sets.out;
  EXPECT_EQ(sets.out.find("! scans/flat.ply: ", first + 1), std::string::npos);
  folder_.write("scans/cut.ply", std::string("ply\nformat ascii 1.0\nelement vertex 9\n"));
  const Finished broken = run({"scans", "photo.png"});
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.err, HasSubstr("cut.ply: "));
}

TEST_F(CompareScans, OptionsOfPicturesAreRefused) {
  const Finished done = run({"scans", "photo.png", "--camera-mm", "900,40", "--exclude-first",
                             "1,2,3,4", "--pitch-deg", "1,2"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(done.err, AllOf(HasSubstr("--camera-mm 900,40"), HasSubstr("seen as from far away"),
                              HasSubstr("--exclude-first: scans is scanned"),
                              HasSubstr("--pitch-deg: scans is scanned")));
  EXPECT_THAT(run({"scans/a.ply", "scans/b.ply", "--base-mm", "210"}).err,
              HasSubstr("--base-mm: scans/a.ply is scanned"));
}

}  // namespace
}  // namespace repose::testing
