#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "dem/shape/clump/surface.h"
#include "tests/dem/shapes.h"

namespace repose::testing {
namespace {

using dem::Chords;
using dem::ClumpSphere;
using dem::ColumnGrid;
using dem::Mesh;
using dem::SurfaceDistance;
using dem::Vector;

TEST(SurfaceDistance, OfABoxIsExactAtFacesEdgesAndCornersOnBothSides) {
  const Mesh box = box_surface(2, 2, 2);
  const SurfaceDistance distance(box);
  EXPECT_DOUBLE_EQ(distance.signed_distance({0.2, 0.1, 3}), 2);
  EXPECT_DOUBLE_EQ(distance.signed_distance({0.2, 0.1, 0.7}), -0.3);
  EXPECT_DOUBLE_EQ(distance.signed_distance({0.2, 4, 5}), 5);
  EXPECT_DOUBLE_EQ(distance.signed_distance({2, 2, 2}), std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(distance.signed_distance({0, 0, 0}), -1);
}

TEST(SurfaceDistance, KnowsInsideFromOutsideInADent) {
  // A box whose upper face is pulled down to the centre of the box: a pyramid of air.
  Mesh dented = box_surface(2, 2, 2);
  const auto middle = static_cast<int>(dented.vertices.size());
  dented.vertices.emplace_back(0, 0, 0);
  std::erase_if(dented.triangles,
                [](const auto& t) { return t[0] >= 4 && t[1] >= 4 && t[2] >= 4; });
  for (const auto& [a, b] : {std::pair(4, 5), {5, 7}, {7, 6}, {6, 4}}) {
    dented.triangles.push_back({middle, a, b});
  }
  const SurfaceDistance distance(dented);
  EXPECT_NEAR(distance.signed_distance({0, 0, 0.5}), 0.5 / std::sqrt(2.0), 1e-12);
  EXPECT_DOUBLE_EQ(distance.signed_distance({0, 0, -0.2}), -0.2);
}

TEST(SampleSurface, SpreadsPointsByArea) {
  const auto samples = dem::sample_surface(box_surface(1, 2, 4), 2800);
  ASSERT_EQ(samples.size(), 2800U);
  const auto on_top = std::count_if(samples.begin(), samples.end(),
                                    [](const auto& sample) { return sample.normal.z() > 0.5; });
  EXPECT_NEAR(static_cast<double>(on_top), 200, 2);  // 2 of 28
  Vector sum = Vector::Zero();
  for (const auto& sample : samples) sum += sample.point;
  EXPECT_LT(sum.norm() / 2800, 0.02);
}

TEST(SampleUnion, LeavesOutWhatIsHiddenInAnotherSphere) {
  // Two equal spheres whose centres are one radius apart: a quarter of each is hidden.
  const std::vector<ClumpSphere> pair = {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}};
  double area = 0;
  for (const auto& point : dem::sample_union(pair, 8000)) area += point.area;
  EXPECT_NEAR(area / (6 * std::numbers::pi), 1, 2e-3);
}

TEST(ColumnGrid, MeasuresABoxExactly) {
  const Mesh box = box_surface(2, 1, 3);
  const ColumnGrid grid({Vector(-2, -2, -2), Vector(2, 2, 2)}, 64);
  const auto body = grid.mass_properties(grid.of_surface(box));
  EXPECT_NEAR(body.volume_m3, 6, 1e-12);
  EXPECT_LT(body.centroid.norm(), 1e-12);
  EXPECT_NEAR(body.second_moment_m2(0, 0), 4.0 / 12, 1e-12);
  EXPECT_NEAR(body.second_moment_m2(2, 2), 9.0 / 12, 1e-12);
}

TEST(ColumnGrid, CountsColumnsThroughEdgesAndCornersOnce) {
  // Columns at the odd multiples of 1/8 run along faces, edges and the faces' diagonals.
  const Mesh box = box_surface(1.25, 1.25, 2);
  const ColumnGrid grid({Vector(-1, -1, -1), Vector(1, 1, 1)}, 8);
  double length = 0;
  for (const Chords& chords : grid.of_surface(box)) {
    ASSERT_LE(chords.size(), 1U);
    for (const auto& chord : chords) {
      EXPECT_DOUBLE_EQ(chord.to - chord.from, 2);
      length += chord.to - chord.from;
    }
  }
  EXPECT_DOUBLE_EQ(length, 50);  // 5 x 5: only one of two opposite faces counts
}

TEST(ColumnGrid, KnowsTheVolumeOfTwoOverlappingSpheres) {
  // Source: volume of a lens of unit spheres a distance d apart, pi (4 + d)(2 - d)^2 / 12.
  const std::vector<ClumpSphere> pair = {{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}};
  const ColumnGrid grid({Vector(-1.5, -1, -1), Vector(1.5, 1, 1)}, 256);
  const double expected = 8 * std::numbers::pi / 3 - std::numbers::pi * 5 / 12;
  EXPECT_NEAR(grid.mass_properties(grid.of_union(pair)).volume_m3 / expected, 1, 1e-3);
}

TEST(ColumnGrid, CountsWhatIsInOneBodyOnlyAsMismatch) {
  const ColumnGrid grid({Vector(-2, -2, -2), Vector(2, 2, 2)}, 64);
  const auto box = grid.of_surface(box_surface(2, 2, 2));
  const auto raised =
      grid.of_surface(moved(box_surface(2, 2, 2), dem::Quaternion::Identity(), Vector(0, 0, 0.25)));
  EXPECT_NEAR(grid.mismatch_m3(box, raised), 2 * 4 * 0.25, 1e-12);
  EXPECT_EQ(grid.mismatch_m3(box, box), 0);
}

}  // namespace
}  // namespace repose::testing
