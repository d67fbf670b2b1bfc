#include "render/silhouette/occlusion.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using repose::testing::nut;
using repose::testing::nut_heap;

TEST(Hidden, ACoreLiesInsideTheShape) {
  EXPECT_NEAR(core_radius_m(nut(), Shown::mesh), 17.46e-3 / 2, 2e-4);
  EXPECT_NEAR(core_radius_m(nut(), Shown::spheres), 5.6e-3, 1e-9);
  EXPECT_NEAR(core_radius_m(dem::sphere_shape(.01), Shown::mesh), .01, 1e-12);
}

TEST(Hidden, AShapeAwayFromItsCentreHasNoCore) {
  dem::ClumpShape shape = nut();
  for (dem::Vector& vertex : shape.surface.vertices) vertex.x() += .1;
  EXPECT_EQ(core_radius_m(shape, Shown::mesh), 0);
  shape.spheres = {{.centre = {.1, 0, 0}, .radius = .01}};
  EXPECT_EQ(core_radius_m(shape, Shown::spheres), 0);
}

TEST(Hidden, AnOpenSurfaceHasNoCore) {
  dem::ClumpShape shape = nut();
  shape.surface.triangles.resize(shape.surface.triangles.size() / 2);
  EXPECT_EQ(core_radius_m(shape, Shown::mesh), 0);
}

TEST(Hidden, MostGrainsInTheMiddleOfALargeHeapAreHidden) {
  const Scene heap = nut_heap(16, .7, 1);
  const View view = view_of(heap, OrthographicCamera{.azimuth_rad = .3}, {1920, 1080});
  const Occlusion occlusion = occluded_part(heap, view, Shown::mesh);
  EXPECT_LT(occlusion.visible.size(), heap.grains.size() / 2);
  EXPECT_GT(occlusion.visible.size(), 0U);
}

TEST(Hidden, AGrainIsHiddenWhereItsWholeDiscLiesBehindAnother) {
  // At .75 the corner of the small disc's box sticks out of the large disc; at .81 so does the
  // disc.
  for (const double away : {0.0, .75, .81}) {
    Scene scene = testing::sphere_scene(.01, {{0, 0, 0}});
    scene.shapes.push_back(dem::sphere_shape(.002));
    const double each_m = away * .01 * std::sqrt(.5);
    scene.grains.push_back({.shape = 1, .number = 1, .pose = {.position = {each_m, .02, each_m}}});
    const OrthographicCamera camera{.mm_per_px = .01, .middle_m = dem::Vector(0, 0, 0)};
    const Occlusion occlusion =
        occluded_part(scene, view_of(scene, camera, {2400, 2400}), Shown::mesh);
    const bool is_seen = std::any_of(occlusion.visible.begin(), occlusion.visible.end(),
                                     [](const PlacedGrain& grain) { return grain.shape == 1; });
    EXPECT_EQ(is_seen, away > .8) << away;
  }
}

}  // namespace
}  // namespace repose::render
