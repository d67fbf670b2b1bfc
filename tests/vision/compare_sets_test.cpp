#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "tests/vision/measured_triangles.h"
#include "vision/compare/heap_sets.h"
#include "vision/drawing/heap_sets_figure.h"

namespace repose::vision {
namespace {

using ::testing::SizeIs;

constexpr double kMargin_rad = 2 * kDegree;

/// A heap with this angle on both sides, seen once.
SeenHeap heap_of(double angle_deg, std::optional<double> m_per_px = {}) {
  return {.views = {measured({.height = 300 * std::tan(angle_deg * kDegree)})},
          .m_per_px = m_per_px};
}

std::vector<SeenHeap> heaps_of(const std::vector<double>& angles_deg) {
  std::vector<SeenHeap> heaps;
  for (const double angle_deg : angles_deg) heaps.push_back(heap_of(angle_deg));
  return heaps;
}

SetComparison compare_sets_of(const std::vector<double>& first, const std::vector<double>& second) {
  return compare_sets(heaps_of(first), heaps_of(second), kMargin_rad);
}

bool sets_warn(const SetComparison& comparison, const std::string& code) {
  return std::any_of(comparison.warnings.begin(), comparison.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

TEST(CompareSets, TheIntervalIsWelchs) {
  // Means 22 and 25, sd 1 and 2, four heaps each: se = sqrt(1/4 + 4/4) = 1.118, df = 4.41.
  const double a = std::sqrt(0.75), b = 2 * a;
  const SetComparison c =
      compare_sets_of({22 - a, 22 - a, 22 + a, 22 + a}, {25 - b, 25 - b, 25 + b, 25 + b});
  EXPECT_NEAR(*c.sets[0].mean_rad / kDegree, 22, kExact);
  EXPECT_NEAR(*c.sets[0].sd_rad / kDegree, 1, kExact);
  EXPECT_NEAR(*c.sets[0].uncertainty_rad / kDegree, 3.182446 / 2, 1e-6);
  EXPECT_NEAR(c.angle->difference_rad / kDegree, -3, kExact);
  EXPECT_NEAR(c.angle->interval_rad[1] / kDegree, -3 + 2.6773 * 1.118034, 1e-3);
}

TEST(CompareSets, ManyHeapsOfOneMeanAreEquivalentAndFewCannotTell) {
  std::vector<double> many;
  for (int i = 0; i < 40; ++i) many.push_back(23 + (i % 2 == 0 ? 1.5 : -1.5));
  EXPECT_EQ(compare_sets_of(many, many).angle->verdict, Agreement::equivalent);
  const SetComparison few = compare_sets_of({21.5, 24.5, 23}, {21.5, 24.5, 23});
  EXPECT_EQ(few.angle->verdict, Agreement::cannot_tell);
  // t(.975; 2n - 2) 1.5 sqrt(2 / n) <= 2 for n >= 6: 1.93; for 5 it is 2.19.
  EXPECT_EQ(few.heaps_to_tell, 6);
}

TEST(CompareSets, ADifferenceNearTheMarginTakesMoreHeapsToTell) {
  // 1 deg apart: half-width 1 is needed. t(.975; 2n - 2) 1.5 sqrt(2 / n): 1.01 for n = 18, .98
  // for 19.
  EXPECT_EQ(compare_sets_of({21.5, 24.5, 23}, {22.5, 25.5, 24}).heaps_to_tell, 19);
}

TEST(CompareSets, MeansThatDifferByMoreThanHeapsDoAreDifferent) {
  EXPECT_EQ(compare_sets_of({20, 20.5, 21}, {27, 27.5, 28}).angle->verdict, Agreement::different);
}

TEST(CompareSets, OneHeapBorrowsTheScatterOfTheOtherSet) {
  // sd 1, n = 1 and 3: t(.975; 2) sqrt(1 + 1/3).
  const SetComparison c = compare_sets_of({25}, {22, 23, 24});
  EXPECT_NEAR(c.angle->interval_rad[1] / kDegree, 2 + 4.302653 * std::sqrt(4.0 / 3), 1e-5);
  EXPECT_TRUE(sets_warn(c, "one_heap"));
}

TEST(CompareSets, OneHeapEachSaysNothingOfTheirKinds) {
  const SetComparison c = compare_sets_of({25}, {22});
  EXPECT_FALSE(c.angle);
  EXPECT_TRUE(c.iou);
  EXPECT_TRUE(sets_warn(c, "one_heap"));
}

TEST(CompareSets, AHeapIsCountedOnceHoweverOftenItIsSeen) {
  std::vector<SeenHeap> seen = heaps_of({20, 30});
  for (int i = 0; i < 8; ++i) seen[0].views.push_back(seen[0].views[0]);
  const SetComparison c = compare_sets(seen, heaps_of({25, 26}), kMargin_rad);
  EXPECT_NEAR(*c.sets[0].mean_rad / kDegree, 25, kExact);
  EXPECT_EQ(c.sets[0].outline.pictures, 10);
}

TEST(CompareSets, AHeapThatMostPicturesRefuseIsLeftOutAndSaid) {
  std::vector<SeenHeap> seen = heaps_of({20, 22, 40});
  ReposeAngle refused;
  refused.reason = "no heap";
  seen[2].views.push_back(refused);
  seen[2].views.push_back(refused);
  const SetComparison c = compare_sets(seen, heaps_of({21, 22}), kMargin_rad);
  EXPECT_EQ(c.sets[0].counted, 2);
  EXPECT_NEAR(*c.sets[0].mean_rad / kDegree, 21, kExact);
  EXPECT_TRUE(sets_warn(c, "heaps_without_angle"));
  EXPECT_TRUE(sets_warn(c, "pictures_without_outline"));
}

TEST(CompareSets, MeanOutlinesOfTrianglesAreExact) {
  // Heights .15 and .075 m on one base: overlap 1/2, mean difference a quarter of .15.
  const std::vector<SeenHeap> high = {{.views = {measured({})}, .m_per_px = 1e-3}};
  const std::vector<SeenHeap> low = {{.views = {measured({.height = 75})}, .m_per_px = 1e-3}};
  const SetComparison c = compare_sets(high, low, kMargin_rad);
  EXPECT_EQ(c.unit, LengthUnit::metre);
  EXPECT_NEAR(*c.iou, 0.5, 1e-3);
  EXPECT_NEAR(*c.profile_mean, 0.15 / 4, 1e-4);
}

TEST(CompareSets, WithoutAScaleForEverySetOnlyShapesAreCompared) {
  const SetComparison c =
      compare_sets({heap_of(25, 1e-3), heap_of(25, 1e-3)}, heaps_of({25, 25}), kMargin_rad);
  EXPECT_EQ(c.unit, LengthUnit::root_area);
  EXPECT_NEAR(*c.iou, 1, 1e-3);
  EXPECT_FALSE(c.profile_mean);
  EXPECT_TRUE(sets_warn(c, "no_scale"));
}

TEST(CompareSets, TheBandHoldsWhatLiesBetween) {
  const SetComparison c = compare_sets_of({20, 22, 24}, {20, 22, 24});
  const MeanOutline& outline = c.sets[0].outline;
  ASSERT_THAT(outline.low, SizeIs(outline.mean.size()));
  for (std::size_t i = 0; i < outline.mean.size(); ++i) {
    EXPECT_LE(outline.low[i].height, outline.mean[i].height + kExact);
    EXPECT_GE(outline.high[i].height, outline.mean[i].height - kExact);
  }
}

TEST(CompareSets, AnEmptySetIsRefused) {
  EXPECT_THROW(compare_sets({}, heaps_of({25}), kMargin_rad), base::InputError);
  EXPECT_THROW(compare_sets(heaps_of({25}), {SeenHeap{}}, kMargin_rad), base::InputError);
  EXPECT_THROW(compare_sets(heaps_of({25}), heaps_of({25}), 0), base::InputError);
}

TEST(CompareSets, AFigureIsDrawnOfWhatThereIs) {
  const HeapSetsNotes notes{.titles = {"photos", "heaps"}, .margin_rad = kMargin_rad};
  const Picture whole = draw_heap_sets(compare_sets_of({20, 22, 24}, {21, 23, 24}), notes);
  EXPECT_EQ(whole.width, 1400);
  std::vector<SeenHeap> refused = {SeenHeap{.views = {ReposeAngle{}}, .m_per_px = {}}};
  const Picture half =
      draw_heap_sets(compare_sets(heaps_of({20, 22}), refused, kMargin_rad), notes);
  EXPECT_GT(half.height, 100);
  EXPECT_THROW(draw_heap_sets(compare_sets(refused, refused, kMargin_rad), notes),
               base::InputError);
}

}  // namespace
}  // namespace repose::vision
