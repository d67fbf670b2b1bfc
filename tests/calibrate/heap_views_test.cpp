#include <algorithm>
#include <array>

#include <gmock/gmock.h>

#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "tests/dem/experiment_model.h"
#include "tests/support/error_of.h"
#include "tests/support/nut_heap.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::nut_heap;
using ::testing::AllOf;
using ::testing::HasSubstr;

const render::Scene& nuts() {
  static const render::Scene scene = nut_heap(17, 27 * kDegree, 3);
  return scene;
}

TakenView taken(const HeapViewing& viewing, int view = 0) {
  static render::Renderer renderer;
  return HeapViewSession(nuts(), viewing).take(renderer, view);
}

/// Whether nothing dark touches the edge of the picture.
bool has_white_edge(const vision::Picture& picture) {
  const auto is_dark = [&](int x, int y) {
    return picture.bgr[3 * (static_cast<std::size_t>(y) * picture.width + x)] < 128;
  };
  for (int x = 0; x < picture.width; ++x) {
    if (is_dark(x, 0) || is_dark(x, picture.height - 1)) return false;
  }
  for (int y = 0; y < picture.height; ++y) {
    if (is_dark(0, y) || is_dark(picture.width - 1, y)) return false;
  }
  return true;
}

TEST(HeapViews, ACameraFarAwaySeesWhatParallelRaysShow) {
  for (const int view : {0, 2}) {
    const TakenView parallel = taken({.views = 3}, view);
    const TakenView far = taken({.views = 3, .camera = dem::LevelCamera{1000, .04}}, view);
    ASSERT_TRUE(parallel.angle.angle_rad && far.angle.angle_rad) << far.angle.reason;
    EXPECT_NEAR(*far.angle.angle_rad / kDegree, *parallel.angle.angle_rad / kDegree, .1);
  }
}

TEST(HeapViews, ACameraNearTheHeapHasAllOfItInThePicture) {
  for (const dem::LevelCamera& camera : {dem::LevelCamera{1.5, .04}, dem::LevelCamera{.5, .02},
                                         dem::LevelCamera{.5, .3}, dem::LevelCamera{.25, .001}}) {
    EXPECT_TRUE(has_white_edge(taken({.views = 1, .camera = camera}).picture))
        << camera.distance_m << ' ' << camera.height_m;
  }
}

TEST(HeapViews, ACameraInTheHeapIsRefused) {
  EXPECT_THAT(error_of([] {
                taken({.views = 1, .camera = dem::LevelCamera{.02, .02}});
              }),
              AllOf(HasSubstr("distance_m is 0.02"), HasSubstr("Fix: ")));
}

/// The foot of the nearest grains appears below that of the middle ones, by pinhole geometry: with
/// h = 40 mm, a distance of 1 m and a heap that comes r nearer, by h r / (1 m - r).
TEST(HeapViews, ANearCameraSeesTheFootInFrontBelowTheMiddlesByPinholeGeometry) {
  const auto height_m = [](const HeapViewing& viewing) {
    const HeapViewSession session(nuts(), viewing);
    const vision::Picture picture = taken(viewing).picture;
    const auto is_dark = [&](int y) {
      const auto row = picture.bgr.begin() + std::ptrdiff_t{3} * y * picture.width;
      return std::any_of(row, row + std::ptrdiff_t{3} * picture.width,
                         [](std::uint8_t value) { return value < 128; });
    };
    int rows = 0;
    for (int y = 0; y < picture.height; ++y) rows += is_dark(y) ? 1 : 0;
    return rows * session.m_per_px();
  };
  double reach_m = 0;
  for (const render::PlacedGrain& grain : nuts().grains) {
    reach_m = std::max(reach_m, -grain.pose.position.y());
  }
  const double lower_m = .04 * reach_m / (1 - reach_m);
  const double seen_m =
      height_m({.views = 1, .camera = dem::LevelCamera{1, .04}}) - height_m({.views = 1});
  // Grains are round: their lowest visible point lies slightly behind or in front of their centre,
  // and the crest is only within a grain of the middle plane.
  EXPECT_NEAR(seen_m, lower_m, .25 * lower_m);
}

TEST(HeapViews, AnotherCameraTakesPicturesAnewOfTheSameHeap) {
  dem::HeapProtocol tube;
  tube.tube_diameter_m = .07;
  tube.tube_height_m = .1;
  tube.lift_speed_m_s = .15;
  tube.plate_m = .3;
  RunSpec spec{.protocol = tube,
               .model = dem::test::soft_bench(),
               .grain_fingerprint = "ball",
               .viewing = {.views = 2}};
  const repose::testing::TemporaryFolder files;
  const RunStore folder(files.path());
  SimulateOptions options;
  options.folder = &folder;
  const std::string far = text_of(simulate_experiment(spec, 1, options));
  spec.viewing.camera = {.distance_m = .4, .height_m = .1};
  EXPECT_FALSE(folder.find_whole(spec, 1)) << "has other pictures";
  const RunResult near = simulate_experiment(spec, 1, options);
  EXPECT_EQ(near.wall_s, run_in(far).wall_s) << "is not simulated again";
  EXPECT_NE(text_of(near), far);
  EXPECT_EQ(text_of(folder.find_whole(spec, 1).value()), text_of(near));
  spec.viewing.camera.reset();
  EXPECT_EQ(text_of(simulate_experiment(spec, 1, options)), far);
}

}  // namespace
}  // namespace repose::calibrate
