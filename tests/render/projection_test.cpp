#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "base/units.h"
#include "render/scene/view.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using dem::Vector;
using repose::testing::nut_heap;
using repose::testing::sphere_scene;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// At (0, -2, 0.1), looking along +y; 36 mm makes the focal length equal to the picture's width.
PerspectiveCamera plain_camera() { return {.position_m = {0, -2, .1}, .focal_mm = 36}; }

const Scene& far_grain() {
  static const Scene scene = sphere_scene(.01, {{0, 0, .1}});
  return scene;
}

TEST(Projection, FollowsThePinholeFormula) {
  const View view = view_of(far_grain(), plain_camera(), {1000, 600});
  for (const Vector& point : {Vector(0, 0, .1), Vector(.3, 0, .2), Vector(-.2, 1, -.3)}) {
    const double depth = point.y() + 2;
    const auto seen = view.project(point);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, 500 + 1000 * point.x() / depth, 1e-9);
    EXPECT_NEAR(seen->y, 300 - 1000 * (point.z() - .1) / depth, 1e-9);
  }
  EXPECT_FALSE(view.project({0, -2.1, .1}));
}

TEST(Projection, PitchLooksDownAndRollLowersTheRightEnd) {
  PerspectiveCamera camera = plain_camera();
  camera.pitch_rad = 10 * kDegree;
  auto seen = view_of(far_grain(), camera, {1000, 600}).project({0, 0, .1});
  EXPECT_NEAR(seen->x, 500, 1e-9);
  EXPECT_NEAR(seen->y, 300 - 1000 * std::tan(camera.pitch_rad), 1e-9);

  camera = plain_camera();
  camera.roll_rad = 5 * kDegree;
  seen = view_of(far_grain(), camera, {1000, 600}).project({.4, 0, .1});
  EXPECT_NEAR(seen->x, 500 + 200 * std::cos(camera.roll_rad), 1e-9);
  EXPECT_NEAR(seen->y, 300 + 200 * std::sin(camera.roll_rad), 1e-9);
}

TEST(Projection, AzimuthWalksCounterClockwise) {
  PerspectiveCamera camera{.position_m = {2, 0, .1}, .azimuth_rad = 90 * kDegree, .focal_mm = 36};
  const auto seen = view_of(far_grain(), camera, {1000, 600}).project({0, .2, .1});
  EXPECT_NEAR(seen->x, 600, 1e-9);
}

TEST(Projection, DistortionIsThePolynomial) {
  PerspectiveCamera camera = plain_camera();
  camera.k1 = -.2;
  camera.k2 = .05;
  const View view = view_of(far_grain(), camera, {1000, 600});
  const auto seen = view.project({.5, 0, .3});
  const double x = .25, y = -.1, r2 = x * x + y * y;
  const double factor = 1 - .2 * r2 + .05 * r2 * r2;
  EXPECT_NEAR(seen->x, 500 + 1000 * factor * x, 1e-9);
  EXPECT_NEAR(seen->y, 300 + 1000 * factor * y, 1e-9);
}

TEST(Projection, WhatIsDrawnLiesWhereTheFormulaPutsIt) {
  for (const double k1 : {0.0, -.3, .4}) {
    PerspectiveCamera camera{.position_m = {.4, -1.5, .3},
                             .azimuth_rad = 8 * kDegree,
                             .pitch_rad = 6 * kDegree,
                             .roll_rad = -3 * kDegree,
                             .focal_mm = 50,
                             .k1 = k1};
    for (const Vector& place : {Vector(0, 0, .1), Vector(.2, .1, .2), Vector(.55, 0, .32)}) {
      const Scene scene = sphere_scene(.004, {place});
      const View view = view_of(scene, camera, {1200, 800});
      const auto seen = view.project(place);
      const Blob blob = blob_of(renderer().draw(scene, camera, {1200, 800}, SilhouetteStyle{}));
      ASSERT_GT(blob.pixels, 30) << k1;
      // Small spheres: the middle of their image is that of their centre to a tenth of a pixel.
      EXPECT_NEAR(blob.x, seen->x, .15) << k1;
      EXPECT_NEAR(blob.y, seen->y, .15) << k1;
    }
  }
}

TEST(Projection, ASphereIsSeenUnderItsAngle) {
  // The cone that touches a sphere on the axis has the half angle asin(r / d).
  const Scene scene = sphere_scene(.2, {{0, 0, .1}});
  const Blob blob = blob_of(renderer().draw(scene, plain_camera(), {1000, 600}, SilhouetteStyle{}));
  const double radius_px = 1000 * std::tan(std::asin(.2 / 2));
  EXPECT_NEAR(blob.pixels, std::numbers::pi * radius_px * radius_px, 80);
}

TEST(Projection, ALensThatFoldsThePictureIsRefused) {
  PerspectiveCamera camera = plain_camera();
  camera.k1 = -1.5;
  EXPECT_THAT(error_of([&] {
                view_of(far_grain(), camera, {1000, 600});
              }),
              AllOf(HasSubstr("folds"), HasSubstr("Fix: ")));
}

TEST(Projection, DistortionGoesOnBeyondThePictureWithoutFolding) {
  PerspectiveCamera camera = plain_camera();
  camera.k1 = -.3;
  const View view = view_of(far_grain(), camera, {1000, 600});
  double last = 0;
  for (double r = .01; r < 50; r *= 1.1) {
    const double seen = distorted_r(view, r);
    EXPECT_GT(seen, last) << r;
    last = seen;
  }
}

TEST(Projection, CamerasInsideTheHeapOrUnderTheGroundAreRefused) {
  const Scene heap = nut_heap(10, .5, 1);
  PerspectiveCamera camera{.position_m = heap.grains[5].pose.position};
  EXPECT_THAT(error_of([&] {
                view_of(heap, camera, {100, 100});
              }),
              AllOf(HasSubstr("inside the heap"), HasSubstr("Fix: ")));
  camera.position_m = {.009, .009, .02};  // between grains
  EXPECT_THAT(error_of([&] { view_of(heap, camera, {100, 100}); }), HasSubstr("inside the heap"));
  camera.position_m = {0, -1, -.5};
  EXPECT_THAT(error_of([&] { view_of(heap, camera, {100, 100}); }), HasSubstr("under the ground"));
  camera.position_m = {0, 0, 1};  // from above is fine
  camera.pitch_rad = 80 * kDegree;
  EXPECT_EQ(error_of([&] { view_of(heap, camera, {100, 100}); }), "");
}

TEST(Projection, NumbersThatAreNoneAreRefused) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto member : {&PerspectiveCamera::azimuth_rad, &PerspectiveCamera::pitch_rad,
                            &PerspectiveCamera::roll_rad, &PerspectiveCamera::focal_mm,
                            &PerspectiveCamera::k1, &PerspectiveCamera::k2}) {
    PerspectiveCamera camera = plain_camera();
    camera.*member = nan;
    EXPECT_THAT(error_of([&] { view_of(far_grain(), camera, {100, 100}); }), HasSubstr("camera: "));
  }
  PerspectiveCamera camera = plain_camera();
  camera.position_m.x() = nan;
  EXPECT_THAT(error_of([&] { view_of(far_grain(), camera, {100, 100}); }), HasSubstr("position"));
}

TEST(Projection, ACameraOnAStandSeesTheWholeHeap) {
  const Scene heap = nut_heap(10, .5, 1);
  for (const double azimuth : {0.0, 2.0}) {
    for (const double pitch_deg : {0.0, 15.0}) {
      const PictureSize size{600, 400};
      const PerspectiveCamera camera = camera_on(
          {.azimuth_rad = azimuth, .distance_m = 1, .pitch_rad = pitch_deg * kDegree}, heap, size);
      const Blob all = blob_of(renderer().draw(heap, camera, size, SilhouetteStyle{}));
      PerspectiveCamera wider = camera;
      wider.focal_mm /= 2;
      const Blob wide = blob_of(renderer().draw(heap, wider, size, SilhouetteStyle{}));
      EXPECT_NEAR(all.pixels, 4 * wide.pixels, .02 * all.pixels);
      EXPECT_NEAR(all.x, 300, 20);  // a heap of few nuts is not symmetric
    }
  }
}

}  // namespace
}  // namespace repose::render
