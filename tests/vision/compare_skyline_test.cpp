#include <cmath>

#include <gtest/gtest.h>

#include "vision/compare/skyline.h"

namespace repose::vision {
namespace {

constexpr double kRounding = 1e-12;

Skyline triangle(double half_base, double height, double middle = 0) {
  return {{middle - half_base, 0}, {middle, height}, {middle + half_base, 0}};
}

TEST(SkylineDifference, OfAHeapWithItselfIsNothing) {
  const Skyline heap = {{-3, 0.1}, {-1, 2}, {0.5, 1.7}, {2, 0}};
  const SkylineDifference same = difference_of(heap, heap, -3, 2);
  EXPECT_EQ(same.iou(), 1);
  EXPECT_EQ(same.rmse(), 0);
  EXPECT_EQ(same.mean(), 0);
}

TEST(SkylineDifference, OfTwoHeightsOnOneBase) {
  const SkylineDifference d = difference_of(triangle(1, 1), triangle(1, 0.5), -1, 1);
  EXPECT_NEAR(d.iou(), 0.5, kRounding);
  EXPECT_NEAR(d.mean(), 0.25, kRounding);
  EXPECT_NEAR(d.rmse(), std::sqrt(0.25 / 3), kRounding);
}

TEST(SkylineDifference, OfSimilarHeapsIsTheSquareOfTheirRatio) {
  const SkylineDifference d = difference_of(triangle(1, 0.4), triangle(0.8, 0.32), -1, 1);
  EXPECT_NEAR(d.iou(), 0.64, kRounding);
}

TEST(SkylineDifference, OfAShiftedHeap) {
  for (const double shift : {0.1, 0.7, 1.9}) {
    const double common = (1 - shift / 2) * (1 - shift / 2);
    const SkylineDifference d = difference_of(triangle(1, 1), triangle(1, 1, shift), -1, 1 + shift);
    EXPECT_NEAR(d.iou(), common / (2 - common), kRounding) << shift;
    EXPECT_NEAR(d.sum, 0, kRounding) << shift;
  }
}

TEST(SkylineDifference, CountsCrossingSidesExactly) {
  // 1 - |x| and 2 - 4 |x| cross at 1/3: common area 2/3 of 1 each.
  const SkylineDifference d = difference_of(triangle(1, 1), triangle(0.5, 2), -1, 1);
  EXPECT_NEAR(d.common, 2.0 / 3, kRounding);
  EXPECT_NEAR(d.covered, 4.0 / 3, kRounding);
  EXPECT_NEAR(d.iou(), 0.5, kRounding);
}

TEST(SkylineDifference, TellsWhichHeapIsHigherOnEachSide) {
  const Skyline leaning = {{-1, 0}, {-0.5, 1}, {1, 0}};
  const Skyline mirrored = {{-1, 0}, {0.5, 1}, {1, 0}};
  EXPECT_GT(difference_of(leaning, mirrored, -1, 0).mean(), 0.1);
  EXPECT_LT(difference_of(leaning, mirrored, 0, 1).mean(), -0.1);
  EXPECT_NEAR(difference_of(leaning, mirrored, -1, 1).mean(), 0, kRounding);
}

TEST(SkylineDifference, ThereIsNothingBeyondTheEnds) {
  const Skyline block = {{0, 2}, {1, 2}};  // ends in leaps
  const SkylineDifference d = difference_of(block, {}, -3, 3);
  EXPECT_NEAR(d.covered, 2, kRounding);
  EXPECT_NEAR(d.squares, 4, kRounding);
  EXPECT_EQ(d.length, 6);
  EXPECT_EQ(d.iou(), 0);
}

TEST(SkylineDifference, OfNoStretchIsEmpty) {
  for (const double to : {0.0, -1.0, std::nan("")}) {
    const SkylineDifference none = difference_of(triangle(1, 1), triangle(1, 1), 0, to);
    EXPECT_EQ(none.length, 0);
    EXPECT_EQ(none.iou(), 0);
    EXPECT_EQ(none.rmse(), 0);
  }
}

TEST(SlabCentre, IsTheMiddleOfAnEvenHeap) {
  EXPECT_NEAR(slab_centre(triangle(3, 1, 7), 0.2, 0.8), 7, kRounding);
}

TEST(SlabCentre, LiesBetweenTipAndBaseOfAnUnevenOne) {
  // The middle at the height t is w/2 + (2 a - w) t / 2, the width goes with 1 - t: mean t is .44.
  const double w = 10, a = 3;
  EXPECT_NEAR(slab_centre({{0, 0}, {a, 1}, {w, 0}}, 0.2, 0.8), w / 2 + (2 * a - w) / 2 * 0.44,
              kRounding);
}

TEST(SlabCentre, DoesNotSeeTipAndToe) {
  const Skyline plain = triangle(1, 1);
  const Skyline odd = {{-9, 0}, {-1, 0.0}, {-0.15, 0.85}, {0.1, 1.4}, {0.15, 0.85}, {1, 0}, {2, 0}};
  EXPECT_NEAR(slab_centre(odd, 0.2, 0.8), slab_centre(plain, 0.2, 0.8), kRounding);
}

TEST(SlabCentre, NeedsSomethingInTheSlab) {
  EXPECT_TRUE(std::isnan(slab_centre(triangle(1, 1), 1.5, 2)));
  EXPECT_TRUE(std::isnan(slab_centre({}, 0.2, 0.8)));
}

TEST(Skyline, PartsEndWhereTheyAreCut) {
  const Skyline part = part_of(triangle(1, 1), -0.5, 0.25);
  ASSERT_EQ(part.size(), 3U);
  EXPECT_EQ(part.front().along, -0.5);
  EXPECT_NEAR(part.front().height, 0.5, kRounding);
  EXPECT_EQ(part.back().along, 0.25);
  EXPECT_NEAR(part.back().height, 0.75, kRounding);
  EXPECT_EQ(part_of({{-1, 2}, {1, 2}}, -0.5, 0.5).size(), 2U) << "both cuts in one line";
}

TEST(Skyline, IsMovedFirstAndEnlargedThen) {
  const Skyline there = placed({{10, 4}, {12, 0}}, 8, 0.5);
  EXPECT_EQ(there[0].along, 1);
  EXPECT_EQ(there[0].height, 2);
  EXPECT_EQ(there[1].along, 2);
}

}  // namespace
}  // namespace repose::vision
