#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "dem/experiment/surface_profile.h"

namespace repose::dem {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A cone of small spheres whose surface is the cone's, to within the spheres' bumps.
std::vector<ClumpSphere> cone(double angle_deg, double height_m, double radius_m,
                              const Vector& at = Vector::Zero()) {
  std::vector<ClumpSphere> spheres;
  const double step = radius_m;
  const int reach = static_cast<int>(height_m / std::tan(angle_deg * kDegree) / step) + 1;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const double from_axis = step * std::hypot(i, j);
      const double top = height_m - from_axis * std::tan(angle_deg * kDegree);
      if (top < radius_m) continue;
      spheres.push_back(
          {.centre = at + Vector(i * step, j * step, top - radius_m), .radius = radius_m});
    }
  }
  return spheres;
}

/// The same with a flat top of this radius.
std::vector<ClumpSphere> frustum(double angle_deg, double height_m, double top_m, double radius_m) {
  const double cut_off_m = top_m * std::tan(angle_deg * kDegree);
  std::vector<ClumpSphere> spheres = cone(angle_deg, height_m + cut_off_m, radius_m);
  for (ClumpSphere& sphere : spheres) {
    sphere.centre.z() = std::min(sphere.centre.z(), height_m - radius_m);
  }
  return spheres;
}

class Cone : public testing::TestWithParam<double> {};

TEST_P(Cone, IsMeasuredWithin3TenthsOfADegree) {
  const SurfaceReading reading = measure_surface(cone(GetParam(), .06, .002));
  // Spheres on a lattice: the envelope is bumpy by up to a tenth of their radius.
  EXPECT_NEAR(reading.angle_deg, GetParam(), .3);
  EXPECT_LT(reading.between_views_deg, .3);
  EXPECT_NEAR(reading.height_m, .06, 1e-4);
  EXPECT_EQ(reading.flanks, 36);
}

INSTANTIATE_TEST_SUITE_P(SurfaceProfile, Cone, testing::Values(10.0, 18.0, 25.0, 35.0, 45.0));

TEST(SurfaceProfile, DoesNotDependOnWhereTheHeapStands) {
  const SurfaceReading here = measure_surface(cone(25, .06, .002));
  const SurfaceReading there = measure_surface(cone(25, .06, .002, {.3, -.2, 0}));
  EXPECT_NEAR(here.angle_deg, there.angle_deg, .05);
  EXPECT_NEAR(here.base_radius_m, there.base_radius_m, 2e-4);
}

TEST(SurfaceProfile, LeavesGrainsBeyondAGapOut) {
  std::vector<ClumpSphere> heap = cone(25, .06, .002);
  const SurfaceReading alone = measure_surface(heap);
  for (int k = 0; k < 20; ++k) {
    const double turn = 2 * std::numbers::pi * k / 20;
    heap.push_back({.centre = {.5 * std::cos(turn), .5 * std::sin(turn), .02}, .radius = .02});
  }
  const SurfaceReading reading = measure_surface(heap, {.views = 1});
  EXPECT_NEAR(reading.base_radius_m, alone.base_radius_m, 1e-3);
  EXPECT_NEAR(reading.angle_deg, alone.first_view_deg, .1);
}

TEST(SurfaceProfile, BelievesTheFlankMoreThanStrayGrainsOnIt) {
  std::vector<ClumpSphere> heap = cone(25, .06, .002);
  // Seen along y, one grain stands out of the right flank at half height.
  heap.push_back({.centre = {.06, 0, .036}, .radius = .003});
  EXPECT_NEAR(measure_surface(heap, {.views = 1}).angle_deg, 25, .5);
}

TEST(SurfaceProfile, AGrainLyingAtTheFootChangesNothing) {
  std::vector<ClumpSphere> heap = cone(25, .06, .002);
  const double alone = measure_surface(heap, {.views = 1}).angle_deg;
  heap.push_back({.centre = {.12, 0, .009}, .radius = .009});
  // But for the columns, which go with the mean radius.
  EXPECT_NEAR(measure_surface(heap, {.views = 1}).angle_deg, alone, .01);
}

TEST(SurfaceProfile, LeavesAnApronOut) {
  std::vector<ClumpSphere> heap = cone(25, .06, .002);
  // A layer a third as high as the heap runs out from its foot at .129 m to .2 m.
  for (int k = -50; k <= 50; ++k) {
    heap.push_back({.centre = {k * 4e-3, 0, .009}, .radius = .009});
  }
  // A line through all of it has 16 degrees.
  EXPECT_NEAR(measure_surface(heap, {.views = 1}).angle_deg, 25, .3);
}

TEST(SurfaceProfile, AHollowFootOfFewLargeGrainsIsNoApron) {
  // Five grains high, 35 degrees above half its height and 14 below: too few grains to tell such a
  // foot from an apron. The upper half alone has 31 degrees.
  constexpr double kGrainRadius = .008;
  const double steep = std::tan(35 * kDegree);
  const double flat = std::tan(14 * kDegree);
  std::vector<ClumpSphere> heap;
  for (int k = -20; k <= 20; ++k) {
    const double x = 1.8 * kGrainRadius * k;
    const double top =
        std::max(.08 - std::abs(x) * steep, .04 - (std::abs(x) - .04 / steep) * flat);
    if (top < 1.3 * kGrainRadius) continue;
    const double z = std::max(kGrainRadius, top - kGrainRadius);
    heap.push_back({.centre = {x, 0, z}, .radius = kGrainRadius});
  }
  EXPECT_NEAR(measure_surface(heap, {.views = 1}).angle_deg, 22, .5);
}

TEST(SurfaceProfile, MeasuresBothSidesOfALopsidedHeap) {
  std::vector<ClumpSphere> ridge;
  for (int k = -100; k <= 100; ++k) {
    const double x = k * 1e-3;
    const double top = .06 - std::abs(x) * std::tan((x < 0 ? 40 : 20) * kDegree);
    if (top > .001) ridge.push_back({.centre = {x, 0, top - .002}, .radius = .002});
  }
  EXPECT_NEAR(measure_surface(ridge, {.views = 1}).angle_deg, 30, .4);
}

TEST(SurfaceProfile, ALayerHasNoFlank) {
  // It falls at its rim alone.
  const SurfaceReading reading = measure_surface(frustum(45, .02, .2, .001));
  EXPECT_EQ(reading.flanks, 0);
  EXPECT_EQ(reading.angle_deg, 0);
  EXPECT_NEAR(reading.height_m, .02, 1e-4);
}

TEST(SurfaceProfile, TheBaseOfALayerEndsNearItsGrains) {
  // Its top falls by a quarter of its height over .2 m: a line that would meet the ground at .8 m.
  std::vector<ClumpSphere> layer;
  for (int i = -50; i <= 50; ++i) {
    for (int j = -50; j <= 50; ++j) {
      const double from_axis = 4e-3 * std::hypot(i, j);
      if (from_axis > .2) continue;
      layer.push_back({.centre = {4e-3 * i, 4e-3 * j, .018 - .025 * from_axis}, .radius = .002});
    }
  }
  const SurfaceReading reading = measure_surface(layer);
  EXPECT_GT(reading.flanks, 0);
  EXPECT_LT(reading.angle_deg, 2);
  EXPECT_NEAR(reading.base_radius_m, .4, .01);
}

TEST(SurfaceProfile, AHeapWithAFlatTopHasFlanks) {
  const SurfaceReading reading = measure_surface(frustum(25, .03, .064, .002));
  EXPECT_EQ(reading.flanks, 36);
  EXPECT_NEAR(reading.angle_deg, 25, 1);
}

TEST(SurfaceProfile, ASingleSphereHasNoFlank) {
  const SurfaceReading reading = measure_surface({{.centre = {0, 0, .01}, .radius = .01}});
  EXPECT_EQ(reading.flanks, 0);
  EXPECT_EQ(reading.angle_deg, 0);
  EXPECT_NEAR(reading.height_m, .02, 1e-9);
}

TEST(SurfaceProfile, RefusesWhatCannotBeMeasured) {
  EXPECT_THROW(measure_surface({}), std::invalid_argument);
  EXPECT_THROW(measure_surface({{.centre = {0, 0, -1}, .radius = .01}}), std::invalid_argument);
  const std::vector<ClumpSphere> heap = cone(25, .06, .002);
  EXPECT_THROW(measure_surface(heap, {.views = 0}), std::invalid_argument);
  EXPECT_THROW(measure_surface(heap, {.window_from = .8, .window_to = .2}), std::invalid_argument);
  EXPECT_THROW(measure_surface(heap, {.window_from = std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace repose::dem
