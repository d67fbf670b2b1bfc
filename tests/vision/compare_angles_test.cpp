#include <gtest/gtest.h>

#include "vision/compare/angle_difference.h"

namespace repose::vision {
namespace {

AngleDifference difference(double a, double u_a, double b, double u_b, double margin) {
  return angle_difference({a, u_a}, {b, u_b}, margin, false);
}

TEST(AngleDifference, AddsTheHalfWidthsInQuadrature) {
  const AngleDifference d = difference(0.50, 0.03, 0.40, 0.04, 0.02);
  EXPECT_NEAR(d.difference_rad, 0.1, 1e-12);
  EXPECT_NEAR(d.interval_rad[0], 0.05, 1e-12);
  EXPECT_NEAR(d.interval_rad[1], 0.15, 1e-12);
}

TEST(AngleDifference, SwappedHeapsSwapItsSignAndKeepTheVerdict) {
  const AngleDifference there = difference(0.50, 0.03, 0.40, 0.04, 0.02);
  const AngleDifference back = difference(0.40, 0.04, 0.50, 0.03, 0.02);
  EXPECT_EQ(there.difference_rad, -back.difference_rad);
  EXPECT_EQ(there.interval_rad[0], -back.interval_rad[1]);
  EXPECT_EQ(there.verdict, back.verdict);
}

TEST(AngleDifference, IsEquivalentWhenTheIntervalLiesInTheMargin) {
  EXPECT_EQ(difference(0.40, 0.003, 0.41, 0.004, 0.02).verdict, Agreement::equivalent);
  EXPECT_EQ(difference(0.40, 0.003, 0.41, 0.004, 0.0149).verdict, Agreement::different)
      << "the interval is .005 to .015";
}

TEST(AngleDifference, ThatMattersNotIsEquivalentThoughItIsSure) {
  EXPECT_EQ(difference(0.400, 0.001, 0.405, 0.001, 0.02).verdict, Agreement::equivalent);
}

TEST(AngleDifference, CannotBeToldWhenTheIntervalIsWiderThanTheMargin) {
  EXPECT_EQ(difference(0.40, 0.03, 0.40, 0.03, 0.02).verdict, Agreement::cannot_tell);
  EXPECT_EQ(difference(0.40, 0.03, 0.43, 0.03, 0.02).verdict, Agreement::cannot_tell);
}

TEST(AngleDifference, IsDifferentWhenTheIntervalLeavesOutZero) {
  EXPECT_EQ(difference(0.40, 0.003, 0.45, 0.004, 0.02).verdict, Agreement::different);
  EXPECT_EQ(difference(0.45, 0.003, 0.40, 0.004, 0.02).verdict, Agreement::different);
}

TEST(AngleDifference, OfOneMeasurementWithItselfHasNoError) {
  const AngleDifference d = angle_difference({0.4, 0.1}, {0.4, 0.1}, 0.02, true);
  EXPECT_EQ(d.interval_rad[0], 0);
  EXPECT_EQ(d.interval_rad[1], 0);
  EXPECT_EQ(d.verdict, Agreement::equivalent);
}

}  // namespace
}  // namespace repose::vision
