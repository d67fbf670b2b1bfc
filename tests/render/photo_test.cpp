#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "render/renderer.h"
#include "render/scene/view.h"
#include "render/truth.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"
#include "vision/measure/repose_angle.h"

namespace repose::render {
namespace {

using repose::testing::nut_heap;
using ::testing::HasSubstr;

constexpr PictureSize kSmall{240, 160};

Rendered photo(const Scene& scene, const PhotoStyle& style, const PictureSize& size = kSmall) {
  return renderer().draw(scene, camera_on({.distance_m = 1}, scene, size), size, style);
}

TEST(Photo, TheSameSeedGivesTheSameBytesAndAnotherOneOthers) {
  const Scene heap = nut_heap(8, .5, 1);
  const auto bytes = [&heap](std::uint64_t seed) {
    return photo(heap, {.passes = 3, .seed = seed}).picture.bgr;
  };
  const auto first = bytes(1);
  EXPECT_NE(bytes(2), first);
  EXPECT_EQ(bytes(1), first);
}

TEST(Photo, NoiseHasTheStrengthAskedFor) {
  const Scene heap = nut_heap(4, .5, 1);
  const PhotoStyle still{.blur_px = 0, .noise = 0, .vignette = 0, .passes = 1};
  PhotoStyle noisy = still;
  noisy.noise = .02;
  const auto clean = photo(heap, still).picture.bgr;
  const auto grainy = photo(heap, noisy).picture.bgr;
  double sum = 0, squares = 0, count = 0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    if (clean[k] < 100) continue;  // below, the sRGB curve is steep
    // From bytes back to light: 2.4 / 1.055 * ... is close to (v / 255)^2.2 here.
    const auto light = [](double byte) { return std::pow(byte / 255, 2.2); };
    const double value = light(clean[k]);
    const double step = (light(grainy[k]) - value) / std::sqrt(value + .02);
    sum += step;
    squares += step * step;
    count += 1;
  }
  ASSERT_GT(count, 10000);
  EXPECT_NEAR(sum / count, 0, .002);
  EXPECT_NEAR(std::sqrt(squares / count), .02, .004);
}

TEST(Photo, TheMaskIsThatOfTheSilhouetteWhereNoWallHides) {
  const Scene heap = nut_heap(8, .5, 1);
  const PerspectiveCamera camera =
      camera_on({.distance_m = 1, .height_m = .2, .pitch_rad = .15}, heap, kSmall);
  const auto seen = renderer().draw(heap, camera, kSmall, PhotoStyle{.passes = 1}).grain_mask;
  const auto black = renderer().draw(heap, camera, kSmall, SilhouetteStyle{}).grain_mask;
  int different = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) different += seen[k] != black[k] ? 1 : 0;
  // The plate hides nothing from above, but the nuts' lowest points dip into it.
  EXPECT_LT(different, 60);

  Scene hidden = heap;  // an upright board in front of the heap
  hidden.walls.push_back(
      {.shape = dem::Box{.half_size = {1, .001, 1}}, .pose = {.position = {0, -.4, 0}}});
  EXPECT_EQ(std::isnan(blob_of(renderer().draw(hidden, camera, kSmall, PhotoStyle{.passes = 1})).x),
            true);
}

TEST(Photo, GrainsStandOutFromTheBackdropAndThrowShadows) {
  const Scene heap = nut_heap(8, .5, 1);
  const Rendered drawn = photo(heap, {.noise = 0, .passes = 8});
  double grains = 0, others = 0, grain_pixels = 0;
  for (std::size_t k = 0; k < drawn.grain_mask.size(); ++k) {
    const double green = drawn.picture.bgr[3 * k + 1];
    const bool is_upper = k < drawn.grain_mask.size() / 4;
    if (drawn.grain_mask[k] != 0) {
      grains += green;
      grain_pixels += 1;
    } else if (is_upper) {
      others += green / (static_cast<double>(drawn.grain_mask.size()) / 4);
    }
  }
  EXPECT_GT(others, 150);
  EXPECT_LT(grains / grain_pixels, others - 50);
}

TEST(Photo, ALevelViewShowsTheTablesFrontBelowThePlate) {
  const Scene heap = nut_heap(8, .5, 1);
  const auto picture = renderer()
                           .draw(heap, OrthographicCamera{.azimuth_rad = .4}, kSmall,
                                 PhotoStyle{.noise = 0, .passes = 2})
                           .picture;
  const auto grey = [&picture](std::size_t y) { return picture.bgr[3 * (240 * y + 120)]; };
  EXPECT_GT(grey(5), 150);
  EXPECT_LT(grey(155), 120);
}

TEST(Photo, TheUnchangedMeasurementFindsTheHeap) {
  const double angle = 30 * std::numbers::pi / 180;
  const Scene heap = nut_heap(22, angle, 1);
  const PictureSize size{960, 540};
  const PerspectiveCamera camera = camera_on({.distance_m = 2.5}, heap, size);
  const Rendered drawn = renderer().draw(heap, camera, size, PhotoStyle{.passes = 8});
  const auto measured = vision::measure_repose_angle(drawn.picture);
  const Truth truth = truth_of(heap, camera, size, Shown::mesh);
  ASSERT_TRUE(measured.angle_rad) << measured.reason;
  ASSERT_TRUE(measured.ground && truth.ground);
  EXPECT_NEAR(*measured.angle_rad, angle, 3 * std::numbers::pi / 180);
  // A person too would choose a line between the middle plane's ground and the plate's front edge.
  const auto front = view_of(heap, camera, size).project({0, -.3, -.002});
  for (const double y : {measured.ground->from.y, measured.ground->to.y}) {
    EXPECT_GT(y, truth.ground->from.y - 2);
    EXPECT_LT(y, front->y + 2);
  }
}

TEST(Photo, StylesThatMakeNoSenseAreRefused) {
  const Scene heap = nut_heap(3, .5, 1);
  EXPECT_THAT(error_of([&] { photo(heap, {.passes = 0}); }), HasSubstr("passes"));
  EXPECT_THAT(error_of([&] { photo(heap, {.noise = std::nan("")}); }), HasSubstr("noise"));
  EXPECT_THAT(error_of([&] { photo(heap, {.grain = {2, 0, 0}}); }), HasSubstr("colour"));
}

}  // namespace
}  // namespace repose::render
