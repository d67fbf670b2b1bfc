#include "vision/measure/line_fit.h"

#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/heap_random.h"

namespace repose::vision {
namespace {

struct Points {
  std::vector<double> x;
  std::vector<double> y;

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
};

constexpr double kSlope = -0.5;
constexpr double kIntercept = 120;

/// A flank's edge: 200 points that scatter by half a pixel around a line; in the lower half,
/// `loose_particles` of them are lifted by 5 to 40 pixels.
Points flank_points(int loose_particles, std::uint64_t seed) {
  testing::Random random(seed);
  Points points;
  for (int i = 0; i < 200; ++i) {
    points.add(i, kIntercept + kSlope * i + random.normal(0, 0.5));
  }
  for (int i = 0; i < loose_particles; ++i) {
    points.y[static_cast<std::size_t>(random.integer(100, 199))] += random.uniform(5, 40);
  }
  return points;
}

TEST(LeastSquaresLine, MatchesTheHandComputedExample) {
  // Means 2.5 and 7; sums of squares 5, 7 (mixed), 14.
  const LineFit line =
      least_squares_line(std::array{1.0, 2.0, 3.0, 4.0}, std::array{6.0, 5.0, 7.0, 10.0});
  EXPECT_DOUBLE_EQ(line.slope, 1.4);
  EXPECT_DOUBLE_EQ(line.intercept, 3.5);
  EXPECT_DOUBLE_EQ(line.r2, 0.7);
  EXPECT_DOUBLE_EQ(line.y(10), 17.5);
}

TEST(LineFits, GiveAnExactLineBack) {
  Points points;
  for (int i = 0; i < 50; ++i) points.add(3.0 * i, kIntercept + kSlope * 3.0 * i);
  for (const LineFit& line :
       {least_squares_line(points.x, points.y), robust_line(points.x, points.y)}) {
    EXPECT_NEAR(line.slope, kSlope, 1e-9);  // rounding of sums over 50 points
    EXPECT_NEAR(line.intercept, kIntercept, 1e-7);
    EXPECT_NEAR(line.r2, 1, 1e-9);
  }
}

TEST(LineFits, AgreeWhereNothingStrays) {
  const Points points = flank_points(0, 1);
  // The biweight's loss of efficiency is 5 %: a small part of the slope's own error, 6e-4.
  EXPECT_NEAR(robust_line(points.x, points.y).slope, least_squares_line(points.x, points.y).slope,
              3e-4);
}

TEST(RobustLine, StraysMoveItLessThanHalfAsMuchAsTheLeastSquaresLine) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Points points = flank_points(60, seed);
    const double robust = robust_line(points.x, points.y).slope - kSlope;
    const double ordinary = least_squares_line(points.x, points.y).slope - kSlope;
    EXPECT_GT(ordinary, 0.04) << "2 degrees: the strays matter";
    // All loose_particles lie in one half, nearly one point in two there: a hard case.
    EXPECT_LT(std::abs(robust), 0.6 * ordinary) << seed;
  }
}

TEST(RobustLine, AFewFarStraysDoNotMoveIt) {
  Points points = flank_points(0, 1);
  const double clean = robust_line(points.x, points.y).slope;
  for (std::size_t i = 180; i < 190; ++i) points.y[i] += 60;
  EXPECT_GT(least_squares_line(points.x, points.y).slope - clean, 0.05);
  // Losing a twentieth of the points is a small part of the slope's own error, 6e-4.
  EXPECT_NEAR(robust_line(points.x, points.y).slope, clean, 3e-4);
}

/// 30 % of the points lie above the line, increasingly towards one end: they tilt the first line,
/// and the scatter around that hides them.
TEST(RobustLine, ThirtyPercentStraysDoNotMoveItOnceTheScaleHasSettled) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    testing::Random random(seed + 100);
    Points points = flank_points(0, seed);
    for (std::size_t i = 0; i < 60; ++i) points.y[60 + i * 140 / 60] += random.uniform(5, 40);
    ASSERT_GT(least_squares_line(points.x, points.y).slope - kSlope, 0.03) << "2 degrees";
    // The slope's own error is 6e-4, and a third of the points are lost.
    EXPECT_NEAR(robust_line(points.x, points.y).slope, kSlope, 3e-3) << seed;
  }
}

TEST(RobustLine, KeepsTheR2OfTheLeastSquaresLine) {
  const Points points = flank_points(60, 1);
  EXPECT_EQ(robust_line(points.x, points.y).r2, least_squares_line(points.x, points.y).r2);
}

TEST(LineFits, AreFiniteOnPointsThatMakeNoLine) {
  const std::vector<Points> degenerate = {
      {{}, {}},
      {{1}, {2}},
      {{1, 2}, {3, 5}},
      {{4, 4, 4, 4, 4}, {1, 2, 3, 4, 5}},
      {{1, 2, 3, 4, 5}, {7, 7, 7, 7, 7}},
      {{4, 4, 4, 4, 4}, {7, 7, 7, 7, 7}},
  };
  for (const Points& points : degenerate) {
    for (const LineFit& line :
         {least_squares_line(points.x, points.y), robust_line(points.x, points.y)}) {
      EXPECT_TRUE(std::isfinite(line.slope)) << points.x.size();
      EXPECT_TRUE(std::isfinite(line.intercept)) << points.x.size();
      EXPECT_TRUE(line.r2 >= 0 && line.r2 <= 1) << line.r2;
    }
  }
}

TEST(LineFits, PointsAboveOneAnotherHaveALevelLineThroughTheirMean) {
  Points points;  // in floating point the mean of seven 0.1 is not 0.1
  for (const double y : {0, 1, 4, 2, 2, 4, 1}) points.add(0.1, y);
  EXPECT_EQ(least_squares_line(points.x, points.y).slope, 0);
  EXPECT_NEAR(least_squares_line(points.x, points.y).intercept, 2, 1e-9);
  EXPECT_EQ(robust_line(points.x, points.y).slope, 0);
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoMiddles) {
  EXPECT_EQ(median(std::array{5.0, 1.0, 3.0}), 3);
  EXPECT_EQ(median(std::array{8.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace repose::vision
