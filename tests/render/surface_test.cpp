#include "render/scene/surface.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "render/scene/view.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using dem::Vector;
using repose::testing::nut;

Vector vertex(const Surface& surface, std::uint32_t corner) {
  const float* first = &surface.vertices[std::size_t{6} * corner];
  return {first[0], first[1], first[2]};
}

double area(const Surface& surface) {
  double sum = 0;
  for (std::size_t k = 0; k < surface.corners.size(); k += 3) {
    const Vector a = vertex(surface, surface.corners[k]);
    sum += .5 * (vertex(surface, surface.corners[k + 1]) - a)
                    .cross(vertex(surface, surface.corners[k + 2]) - a)
                    .norm();
  }
  return sum;
}

TEST(Surface, LooserTolerancesTakeFewerTriangles) {
  const dem::Mesh mesh = nut().surface;
  std::size_t last = mesh.triangles.size() + 1;
  for (const double tolerance_m : {1e-9, 2e-5, 1e-4, 5e-4}) {
    const Surface surface = grain_surface(mesh, tolerance_m);
    EXPECT_LT(surface.triangles(), last);
    EXPECT_GT(surface.triangles(), 10U);
    last = surface.triangles();
  }
}

TEST(Surface, FewerTrianglesKeepTheSilhouettesArea) {
  const dem::Mesh mesh = nut().surface;
  const double whole = area(grain_surface(mesh, 0));
  for (const double tolerance_m : {2e-5, 1e-4, 3e-4}) {
    EXPECT_NEAR(area(grain_surface(mesh, tolerance_m)), whole, 1e-4 * whole) << tolerance_m;
  }
}

TEST(Surface, ABedIsDrawnAsFarAsTheSlabReachesAndNoFarther) {
  const dem::SphereBed bed{.spheres = {{{.01, .02, 0}, .003}}, .tile = .05};
  const auto triangles = [&](double half_m) {
    return wall_surface(bed, {.01, .02, 0}, half_m, 1e9).triangles();
  };
  const std::size_t one = triangles(.04);
  EXPECT_GT(one, 20U);
  EXPECT_EQ(triangles(.06), 9 * one);
  EXPECT_LT(triangles(1e6), 30000 * one) << "a board without end has a limit";
}

TEST(Surface, NoToleranceLeavesAGrainWithoutTriangles) {
  EXPECT_GT(grain_surface(nut().surface, 1).triangles(), 0U);
  EXPECT_GT(sphere_surface({{.centre = Vector::Zero(), .radius = 1e-3}}, 1).triangles(), 0U);
}

TEST(Surface, NormalsPointOutwardsAndAreUnits) {
  for (const Surface& surface :
       {grain_surface(nut().surface, 1e-4), sphere_surface(nut().spheres, 1e-5)}) {
    for (std::size_t k = 0; k < surface.vertices.size(); k += 6) {
      const float* v = &surface.vertices[k];
      const Vector normal(v[3], v[4], v[5]);
      EXPECT_NEAR(normal.norm(), 1, 1e-5);
      EXPECT_GT(normal.dot(Vector(v[0], v[1], v[2])), 0);
    }
  }
}

TEST(Surface, ASphereHasTheSurfaceOfASphere) {
  for (const double tolerance_m : {1e-5, 1e-4, 1e-3}) {
    const Surface surface = sphere_surface({{.centre = {1, 2, 3}, .radius = .01}}, tolerance_m);
    EXPECT_NEAR(area(surface), 4 * std::numbers::pi * 1e-4, 1e-8) << tolerance_m;
  }
}

TEST(Surface, TrianglesInsideAnotherSphereAreLeftOutWithoutATrace) {
  const std::vector<dem::ClumpSphere> apart = {{.centre = {-1, 0, 0}, .radius = .01},
                                               {.centre = {1, 0, 0}, .radius = .01}};
  const std::vector<dem::ClumpSphere> nested = {{.centre = {0, 0, 0}, .radius = .01},
                                                {.centre = {.001, 0, 0}, .radius = .003}};
  EXPECT_EQ(sphere_surface(apart, 1e-5).triangles(),
            2 * sphere_surface({apart[0]}, 1e-5).triangles());
  EXPECT_EQ(sphere_surface(nested, 1e-5).triangles(),
            sphere_surface({nested[0]}, 1e-5).triangles());
}

TEST(Surface, WallsAreClosedAndAsLargeAsTheyAre) {
  const Surface box = wall_surface(dem::Box{.half_size = {1, 2, 3}}, Vector::Zero(), 1, 1e9);
  EXPECT_EQ(box.triangles(), 12U);
  EXPECT_NEAR(area(box), 8 * (1 * 2 + 2 * 3 + 1 * 3), 1e-4);
  const Surface fine = wall_surface(dem::Box{.half_size = {1, 2, 3}}, Vector::Zero(), 1, .1);
  EXPECT_GT(fine.triangles(), 10000U);
  EXPECT_NEAR(area(fine), area(box), 1e-3);
  const Surface tube = wall_surface(dem::Tube{.inner_radius = 1, .thickness = .1, .height = 2},
                                    Vector::Zero(), 1, 1e9);
  const double round = 2 * std::numbers::pi;
  EXPECT_NEAR(area(tube), round * (1 + 1.1) * 2 + round * (1.1 * 1.1 - 1), .02);
}

}  // namespace
}  // namespace repose::render
