#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "render/renderer.h"
#include "render/truth.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"
#include "vision/measure/repose_angle.h"

namespace repose::render {
namespace {

using dem::Vector;
using repose::testing::nut_heap;
using repose::testing::sphere_scene;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

/// 1 mm per pixel, the origin in the middle of the picture.
OrthographicCamera plain_camera(double azimuth_rad) {
  return {.azimuth_rad = azimuth_rad, .mm_per_px = 1, .middle_m = Vector::Zero()};
}

TEST(Silhouette, ASphereHasItsAreaAndItsPlaceAtEveryAzimuth) {
  const double radius_m = .1;
  const Vector place(.08, -.05, .04);
  const Scene scene = sphere_scene(radius_m, {place});
  for (const double azimuth : {0.0, .3, 1.2, kPi / 2, 2.9, -1.7}) {
    const Blob blob =
        blob_of(renderer().draw(scene, plain_camera(azimuth), {400, 300}, SilhouetteStyle{}));
    // A circle of 100 px radius has 31416 pixels; pixels on its edge add a random 10 or so.
    EXPECT_NEAR(blob.pixels, kPi * 100 * 100, 60) << azimuth;
    const double right = 1e3 * (place.x() * std::cos(azimuth) + place.y() * std::sin(azimuth));
    EXPECT_NEAR(blob.x, 200 + right, .05) << azimuth;
    EXPECT_NEAR(blob.y, 150 - 40, .05) << azimuth;
  }
}

TEST(Silhouette, BlackIsTheMaskAndAllElseIsWhite) {
  const Rendered drawn =
      renderer().draw(nut_heap(8, .5, 1), OrthographicCamera{}, {320, 180}, SilhouetteStyle{});
  ASSERT_EQ(drawn.grain_mask.size(), 320U * 180U);
  ASSERT_EQ(drawn.picture.bgr.size(), 3U * 320U * 180U);
  for (std::size_t k = 0; k < drawn.grain_mask.size(); ++k) {
    ASSERT_TRUE(drawn.grain_mask[k] == 0 || drawn.grain_mask[k] == 255);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(drawn.picture.bgr[3 * k + c], 255 - drawn.grain_mask[k]);
    }
  }
  EXPECT_GT(blob_of(drawn).pixels, 1000);
}

TEST(Silhouette, FromBehindItIsItsMirrorImage) {
  const Scene scene = nut_heap(8, .5, 2);
  const Rendered front = renderer().draw(scene, plain_camera(0), {400, 300}, SilhouetteStyle{});
  const Rendered back = renderer().draw(scene, plain_camera(kPi), {400, 300}, SilhouetteStyle{});
  int different = 0;
  for (std::size_t y = 0; y < 300; ++y) {
    for (std::size_t x = 0; x < 400; ++x) {
      if (front.grain_mask[400 * y + x] != back.grain_mask[400 * y + 399 - x]) ++different;
    }
  }
  // Only pixels whose middle lies on an edge to the last bit may differ.
  EXPECT_LE(different, 5);
}

TEST(Silhouette, TheWholeHeapFitsWithRoomAround) {
  for (const double azimuth : {0.0, 1.0}) {
    const Rendered drawn = renderer().draw(nut_heap(9, .5, 3), OrthographicCamera{azimuth, {}, {}},
                                           {500, 200}, SilhouetteStyle{});
    int first = 500, last = -1;
    for (int k = 0; k < 500 * 200; ++k) {
      if (drawn.grain_mask[static_cast<std::size_t>(k)] == 0) continue;
      first = std::min(first, k % 500);
      last = std::max(last, k % 500);
      EXPECT_GE(k / 500, 15);
      EXPECT_LT(k / 500, 185);
    }
    EXPECT_GE(first, 40);
    EXPECT_LT(last, 460);
  }
}

TEST(Silhouette, IsTheUnionOfItsGrainsThoughHiddenOnesAreNotDrawn) {
  const Scene heap = nut_heap(9, .6, 6);
  OrthographicCamera camera = fitted_all_around({}, heap, {300, 200});
  for (const double mm_per_px : {*camera.mm_per_px, .3, .05}) {
    camera.mm_per_px = mm_per_px;
    std::vector<std::uint8_t> together(std::size_t{300} * 200);
    for (const PlacedGrain& grain : heap.grains) {
      const Scene alone{.shapes = heap.shapes, .grains = {grain}, .walls = {}};
      const auto mask = renderer().draw(alone, camera, {300, 200}, SilhouetteStyle{}).grain_mask;
      for (std::size_t k = 0; k < mask.size(); ++k) together[k] |= mask[k];
    }
    const auto whole = renderer().draw(heap, camera, {300, 200}, SilhouetteStyle{}).grain_mask;
    int different = 0;
    for (std::size_t k = 0; k < whole.size(); ++k) different += whole[k] != together[k] ? 1 : 0;
    EXPECT_LE(different, 3) << mm_per_px;  // an edge exactly through a pixel's middle
  }
}

TEST(Silhouette, SpheresAndSurfacesAreDrawnAsAsked) {
  const Scene scene = nut_heap(6, .5, 1);
  const auto pixels = [&scene](Shown shown) {
    return blob_of(
               renderer().draw(scene, plain_camera(0), {400, 300}, SilhouetteStyle{.shown = shown}))
        .pixels;
  };
  // The spheres are shorter than the nut, and inside it.
  EXPECT_LT(pixels(Shown::spheres), pixels(Shown::mesh));
  EXPECT_NEAR(pixels(Shown::both), pixels(Shown::mesh), .01 * pixels(Shown::mesh));
}

TEST(Silhouette, TheSameBytesAgainFromTheSameAndFromAnotherRenderer) {
  const Scene scene = nut_heap(9, .5, 5);
  const auto draw = [&scene](Renderer& by, double azimuth) {
    return by.draw(scene, OrthographicCamera{.azimuth_rad = azimuth}, {640, 360}, SilhouetteStyle{})
        .picture.bgr;
  };
  const auto first = draw(renderer(), .4);
  draw(renderer(), 1.4);
  EXPECT_EQ(draw(renderer(), .4), first);
  Renderer another;
  EXPECT_EQ(draw(another, .4), first);
}

TEST(Silhouette, IsMeasuredByTheSameCodeAsPhotographs) {
  const double angle = 30 * kPi / 180;
  const Rendered drawn = renderer().draw(nut_heap(30, angle, 1), OrthographicCamera{}, {1920, 1080},
                                         SilhouetteStyle{});
  const auto measured = vision::measure_repose_angle(drawn.picture);
  ASSERT_TRUE(measured.angle_rad) << measured.reason;
  // The layers' steps take a third of the tolerance; the cone itself is exact.
  EXPECT_NEAR(*measured.angle_rad, angle, 2 * kPi / 180);
}

TEST(Silhouette, PicturesThatCannotBeDrawnAreRefusedInOneLine) {
  const Scene scene = sphere_scene(.01, {Vector::Zero()});
  const auto error = [&scene](PictureSize size) {
    return error_of([&] { renderer().draw(scene, OrthographicCamera{}, size, SilhouetteStyle{}); });
  };
  for (const PictureSize size : {PictureSize{0, 10}, PictureSize{10, 0}, PictureSize{-1, 10},
                                 PictureSize{16385, 10}, PictureSize{16384, 16384}}) {
    const std::string text = error(size);
    EXPECT_THAT(text, AllOf(HasSubstr("picture size = "), HasSubstr("Rule: "), HasSubstr("Fix: ")));
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_EQ(error({1, 1}), "");
  EXPECT_EQ(error({16384, 4}), "");
}

TEST(Silhouette, TheWidestPictureIsNotBlank) {
  const Scene scene = sphere_scene(.01, {Vector::Zero()});
  const Rendered drawn = renderer().draw(scene, OrthographicCamera{.mm_per_px = 2 * 10.0 / 16384},
                                         {16384, 8}, SilhouetteStyle{});
  EXPECT_GT(blob_of(drawn).pixels, 16000 * 8);
}

TEST(Silhouette, ScenesWithoutGrainsAndScalesThatAreNoneAreRefused) {
  const OrthographicCamera placed{.mm_per_px = 1, .middle_m = Vector::Zero()};
  for (const OrthographicCamera& camera : {OrthographicCamera{}, placed}) {
    EXPECT_THAT(error_of([&] {
                  renderer().draw(Scene{}, camera, {10, 10}, SilhouetteStyle{});
                }),
                HasSubstr("no grains"));
  }
  const Scene scene = sphere_scene(.01, {Vector::Zero()});
  for (const double scale : {0.0, -1.0, std::nan(""), 1e300}) {
    EXPECT_THAT(error_of([&] {
                  renderer().draw(scene, OrthographicCamera{.mm_per_px = scale}, {10, 10},
                                  SilhouetteStyle{});
                }),
                HasSubstr("mm_per_px"))
        << scale;
  }
  EXPECT_THAT(error_of([&] {
                renderer().draw(scene, OrthographicCamera{.azimuth_rad = std::nan("")}, {10, 10},
                                SilhouetteStyle{});
              }),
              HasSubstr("azimuth"));
}

TEST(Silhouette, TheGroundIsDrawnWhereItIsWhenAskedFor) {
  Scene scene = sphere_scene(.05, {{0, 0, .05}});
  scene.walls.push_back(repose::testing::plate(.3));
  const Rendered drawn =
      renderer().draw(scene, plain_camera(0), {200, 200}, SilhouetteStyle{.shows_ground = true});
  const auto grey = [&drawn](std::size_t x, std::size_t y) {
    return drawn.picture.bgr[3 * (200 * y + x)];
  };
  EXPECT_EQ(grey(10, 99), 255);
  EXPECT_EQ(grey(10, 100), 128);
  EXPECT_EQ(grey(100, 90), 0);
}

}  // namespace
}  // namespace repose::render
