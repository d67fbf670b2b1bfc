#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/run_result.h"
#include "dem/experiment/heap.h"
#include "tests/dem/experiment_model.h"
#include "tests/support/sphere_heap.h"

namespace repose::calibrate {
namespace {

using dem::ClumpSphere;
using repose::testing::sphere_cone;
using repose::testing::sphere_frustum;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

PositionAngle angle_of(const std::vector<ClumpSphere>& heap, int views = 18) {
  return position_angle(dem::heap_envelopes(heap, views));
}

class Cone : public ::testing::TestWithParam<double> {};

TEST_P(Cone, IsMeasuredWithin3TenthsOfADegree) {
  const PositionAngle angle = angle_of(sphere_cone(GetParam(), .06, .002));
  // Spheres on a lattice: the envelope is bumpy by up to a tenth of their radius.
  EXPECT_NEAR(angle.angle_deg.value(), GetParam(), .3);
  EXPECT_LT(angle.between_views_deg.value(), .3);
  EXPECT_EQ(angle.flanks, 36);
}

INSTANTIATE_TEST_SUITE_P(PositionAngle, Cone, ::testing::Values(10.0, 18.0, 25.0, 35.0, 45.0));

TEST(PositionAngle, DoesNotDependOnWhereTheHeapStands) {
  const PositionAngle here = angle_of(sphere_cone(25, .06, .002));
  const PositionAngle there = angle_of(sphere_cone(25, .06, .002, {.3, -.2, 0}));
  EXPECT_NEAR(here.angle_deg.value(), there.angle_deg.value(), .05);
  EXPECT_NEAR(here.base_radius_m.value(), there.base_radius_m.value(), 2e-4);
  EXPECT_NEAR(here.base_radius_m.value(), .06 / std::tan(25 * kDegree), 2e-3);
}

TEST(PositionAngle, TheFirstViewIsThatAlongY) {
  // A ridge along y: seen along y 30 degrees, from the side a wall.
  std::vector<ClumpSphere> ridge;
  for (int i = -50; i <= 50; ++i) {
    const double top = .06 - std::abs(i) * 2e-3 * std::tan(30 * kDegree);
    for (int j = -20; top > .002 && j <= 20; ++j) {
      ridge.push_back({.centre = {i * 2e-3, j * 2e-3, top - .002}, .radius = .002});
    }
  }
  EXPECT_NEAR(angle_of(ridge, 2).first_view_deg.value(), 30, .4);
}

TEST(PositionAngle, BelievesTheFlankMoreThanStrayGrainsOnIt) {
  std::vector<ClumpSphere> heap = sphere_cone(25, .06, .002);
  // Seen along y, one grain sticks out of the right flank at half height.
  heap.push_back({.centre = {.06, 0, .036}, .radius = .003});
  EXPECT_NEAR(angle_of(heap, 1).angle_deg.value(), 25, .5);
}

TEST(PositionAngle, AGrainLyingAtTheFootChangesNothing) {
  std::vector<ClumpSphere> heap = sphere_cone(25, .06, .002);
  const double alone = angle_of(heap, 1).angle_deg.value();
  heap.push_back({.centre = {.12, 0, .009}, .radius = .009});
  // Apart from the columns, whose width depends on the mean radius.
  EXPECT_NEAR(angle_of(heap, 1).angle_deg.value(), alone, .01);
}

TEST(PositionAngle, LeavesAnApronOut) {
  std::vector<ClumpSphere> heap = sphere_cone(25, .06, .002);
  // A layer a third as high as the heap extends from its foot at .129 m to .2 m.
  for (int k = -50; k <= 50; ++k) {
    heap.push_back({.centre = {k * 4e-3, 0, .009}, .radius = .009});
  }
  // A line through all of it is at 16 degrees.
  EXPECT_NEAR(angle_of(heap, 1).angle_deg.value(), 25, .3);
}

TEST(PositionAngle, AHollowFootOfFewLargeGrainsCountsMoreThanTheFlankAboveIt) {
  // Five grains high, 35 degrees above half its height and 14 below: too few grains to tell such a
  // foot from an apron. The line through both is at 18.1 degrees, that of the upper half at 31.
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
  EXPECT_GT(angle_of(heap, 1).angle_deg.value(), 18.1);
  EXPECT_LT(angle_of(heap, 1).angle_deg.value(), 18.1 + (31 - 18.1) / 4);
}

TEST(PositionAngle, MeasuresBothSidesOfALopsidedHeap) {
  std::vector<ClumpSphere> ridge;
  for (int k = -100; k <= 100; ++k) {
    const double x = k * 1e-3;
    const double top = .06 - std::abs(x) * std::tan((x < 0 ? 40 : 20) * kDegree);
    if (top > .001) ridge.push_back({.centre = {x, 0, top - .002}, .radius = .002});
  }
  EXPECT_NEAR(angle_of(ridge, 1).angle_deg.value(), 30, .4);
}

TEST(PositionAngle, ALayerHasNone) {
  // It slopes only at its rim.
  const PositionAngle angle = angle_of(sphere_frustum(45, .02, .2, .001));
  EXPECT_EQ(angle.flanks, 0);
  EXPECT_FALSE(angle.angle_deg);
  EXPECT_FALSE(angle.base_radius_m);
  EXPECT_FALSE(angle.first_view_deg);
  EXPECT_FALSE(angle.between_views_deg);
}

/// Grains as they stood in the tube, 32 on top of each other.
std::vector<ClumpSphere> column() {
  std::vector<ClumpSphere> grains;
  for (int layer = 0; layer < 32; ++layer) {
    for (int i = -6; i <= 6; ++i) {
      for (int j = -6; j <= 6; ++j) {
        const double x = 1e-3 * i, y = 1e-3 * j;
        if (std::hypot(x, y) > 6.1e-3) continue;
        grains.push_back({.centre = {x, y, 1e-3 + 2e-3 * layer}, .radius = 1e-3});
      }
    }
  }
  return grains;
}

TEST(PositionAngle, AColumnThatStandsHasNone) {
  const PositionAngle angle = angle_of(column());
  EXPECT_EQ(angle.flanks, 0);
  EXPECT_FALSE(angle.angle_deg);
}

TEST(PositionAngle, OneSideThatLeansIsNoHeap) {
  // Grains that came off one side lean against it; all others are still upright.
  std::vector<ClumpSphere> heap = column();
  for (int i = 1; i <= 60; ++i) {
    const double x = 5e-3 + 1e-3 * i;
    for (double z = 1e-3; z < .063 - (x - 5e-3); z += 1e-3) {
      heap.push_back({.centre = {x, 0, z}, .radius = 1e-3});
    }
  }
  EXPECT_NEAR(angle_of(heap, 1).angle_deg.value(), 45, 5) << "one of two sides, seen along y";
  const PositionAngle all_around = angle_of(heap);
  EXPECT_GT(all_around.flanks, 0);
  EXPECT_LT(all_around.flanks, 18);
  EXPECT_FALSE(all_around.angle_deg);
  EXPECT_FALSE(all_around.first_view_deg);
}

TEST(PositionAngle, ASingleViewHasNoScatterBetweenViews) {
  EXPECT_FALSE(angle_of(sphere_cone(25, .06, .002), 1).between_views_deg);
}

TEST(PositionAngle, TheBaseOfALayerEndsNearItsGrains) {
  // Its top falls by a quarter of its height over .2 m: such a line meets the ground at .8 m.
  std::vector<ClumpSphere> layer;
  for (int i = -50; i <= 50; ++i) {
    for (int j = -50; j <= 50; ++j) {
      const double from_axis = 4e-3 * std::hypot(i, j);
      if (from_axis > .2) continue;
      layer.push_back({.centre = {4e-3 * i, 4e-3 * j, .018 - .025 * from_axis}, .radius = .002});
    }
  }
  const PositionAngle angle = angle_of(layer);
  EXPECT_GT(angle.flanks, 0);
  EXPECT_LT(angle.angle_deg.value(), 2);
  EXPECT_NEAR(angle.base_radius_m.value(), .4, .01);
}

TEST(PositionAngle, AHeapWithAFlatTopHasFlanks) {
  const PositionAngle angle = angle_of(sphere_frustum(25, .03, .064, .002));
  EXPECT_EQ(angle.flanks, 36);
  EXPECT_NEAR(angle.angle_deg.value(), 25, 1);
}

TEST(PositionAngle, ASingleSphereHasNone) {
  const PositionAngle angle = angle_of({{.centre = {0, 0, .01}, .radius = .01}});
  EXPECT_EQ(angle.flanks, 0);
  EXPECT_FALSE(angle.angle_deg);
}

TEST(PositionAngle, RoughGrainsHeapWhereSmoothOnesSpreadToALayer) {
  const auto angle_deg = [](const dem::PairCoefficients& wall, const dem::PairCoefficients& grain) {
    dem::Model model = dem::test::sphere_bench();
    model.stiffness_factor = 1e-3;
    model.grain_wall = wall;
    model.grain_grain = grain;
    dem::HeapProtocol protocol;
    protocol.tube_diameter_m = .07;
    protocol.tube_height_m = .1;
    protocol.lift_speed_m_s = .1;
    protocol.plate_m = .3;
    RunResult heap;
    static_cast<dem::Repeat&>(heap) = run_heap(model, protocol, 1);
    add_position_angle(heap);
    return heap.value;
  };
  const double rough = angle_deg({.31, .5, .2}, {.11, .5, .2}).value();
  EXPECT_GT(rough, 3);
  EXPECT_LT(rough, 60);
  EXPECT_FALSE(angle_deg({.31, .2, .02}, {.11, .1, .01}));
}

TEST(PositionAngle, CompletesAHeapsReadings) {
  RunResult heap;
  const auto envelopes = dem::heap_envelopes(sphere_cone(25, .06, .002), 18);
  heap.envelopes = envelopes;
  const PositionAngle angle = position_angle(envelopes);
  add_position_angle(heap);
  EXPECT_EQ(heap.other_deg, position_angle(envelopes, {.has_definitions = true}).other_deg);
  EXPECT_EQ(heap.value.value(), angle.angle_deg.value());
  EXPECT_THAT(heap.envelopes, IsEmpty());
  EXPECT_THAT(heap.readings, UnorderedElementsAre(Key("base_radius_mm"), Key("between_views_deg"),
                                                  Key("angle_xz_deg"), Key("inner_window_deg")));
  EXPECT_EQ(heap.readings.at("base_radius_mm"), 1e3 * angle.base_radius_m.value());
  EXPECT_EQ(heap.readings.at("angle_xz_deg"), angle.first_view_deg.value());
  EXPECT_NEAR(heap.readings.at("inner_window_deg"), 25, .3);
}

TEST(PositionAngle, OfALayerNothingIsRead) {
  RunResult layer;
  layer.envelopes = dem::heap_envelopes(sphere_cone(25, .06, .002), 18);
  layer.readings["no_heap"] = 1;  // as if its grains were that large
  add_position_angle(layer);
  EXPECT_FALSE(layer.value);
  for (const char* name :
       {"base_radius_mm", "between_views_deg", "angle_xz_deg", "inner_window_deg"}) {
    EXPECT_THAT(layer.readings, Contains(Pair(name, std::nullopt)));
  }
}

}  // namespace
}  // namespace repose::calibrate
