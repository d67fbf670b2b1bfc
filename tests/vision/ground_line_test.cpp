#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "vision/measure/ground.h"

namespace repose::vision {
namespace {

constexpr double kTolerance = 3;

/// Points of y(x) at x = 0.5, 1.5, ...
template <class Y>
std::vector<Point> points_of(int count, Y y) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back({i + 0.5, y(i + 0.5)});
  return points;
}

TEST(SupportLine, LevelPoints) {
  const auto ground = support_line(points_of(100, [](double) { return 50.0; }), kTolerance);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->line.slope, 0, 1e-12);
  EXPECT_NEAR(ground->line.y(50), 50, 1e-9);
  EXPECT_EQ(ground->fraction, 1);
}

TEST(SupportLine, TiltedPoints) {
  for (const double tilt_deg : {-7.0, -2.0, 0.3, 5.0}) {
    const double slope = std::tan(tilt_deg * kDegree);
    const auto ground =
        support_line(points_of(300, [&](double x) { return 80 + slope * x; }), kTolerance);
    ASSERT_TRUE(ground) << tilt_deg;
    EXPECT_NEAR(ground->line.tilt_rad(), tilt_deg * kDegree, 1e-9);
  }
}

TEST(SupportLine, WhatStandsOnTheGroundDoesNotLiftIt) {
  const double slope = std::tan(1.5 * kDegree);
  // A heap over 40 % of the width, 30 degrees steep.
  const auto outline = [&](double x) {
    return 200 + slope * x - std::max(0.0, 60 - 0.58 * std::abs(x - 250));
  };
  const auto ground = support_line(points_of(500, outline), kTolerance);
  ASSERT_TRUE(ground);
  // The heap's two toes lie within the tolerance, five points each of 300: they must not tilt it.
  EXPECT_NEAR(ground->line.tilt_rad(), 1.5 * kDegree, 0.02 * kDegree);
  EXPECT_NEAR(ground->line.y(250), 200 + slope * 250, 0.2);
  EXPECT_NEAR(ground->fraction, 0.6, 0.03);
}

TEST(SupportLine, AFlatTopLongerThanTheGroundIsNotTheGround) {
  const auto outline = [](double x) { return std::abs(x - 200) < 110 ? 50.0 : 100.0; };
  const auto ground = support_line(points_of(400, outline), kTolerance);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->line.y(200), 100, 1e-9);
}

TEST(SupportLine, GapsUnderLargeGrainsDoNotLiftIt) {
  // Grains of 20 px: their lower edges touch the ground only at every 20th point.
  const auto bottoms = [](double x) {
    const double from_middle = std::fmod(x, 20) - 10;
    return 100 - 10 + std::sqrt(std::max(0.0, 100 - from_middle * from_middle));
  };
  const auto ground = support_line(points_of(400, bottoms), kTolerance);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->line.tilt_rad(), 0, 0.1 * kDegree);
  EXPECT_NEAR(ground->line.y(200), 100, kTolerance) << "the grains' feet, not their middles";
}

TEST(SupportLine, SlopesSteeperThanATripodAreNoGround) {
  const double slope = std::tan(12 * kDegree);
  EXPECT_FALSE(support_line(points_of(200, [&](double x) { return slope * x; }), kTolerance));
}

TEST(SupportLine, ALineWithMuchBelowItIsNoGround) {
  // A level edge over the right third; the rest lies lower, on slopes without any level line.
  const auto outline = [](double x) { return x > 200 ? 50.0 : 60 + std::abs(x - 100); };
  const auto ground = support_line(points_of(300, outline), kTolerance);
  EXPECT_TRUE(!ground || ground->line.y(250) > 150) << "at y = " << ground->line.y(250);
}

TEST(SupportLine, NeedsEightPoints) {
  EXPECT_FALSE(support_line({}, kTolerance));
  EXPECT_FALSE(support_line(points_of(7, [](double) { return 5.0; }), kTolerance));
  EXPECT_TRUE(support_line(points_of(8, [](double) { return 5.0; }), kTolerance));
}

TEST(SupportLine, PointsInOneColumnAreNoLine) {
  EXPECT_FALSE(support_line(std::vector<Point>(20, Point{4, 4}), kTolerance));
}

/// Bases are ragged over a grain's length: neighbouring points are correlated.
TEST(SupportLine, DeviationIsTheTiltsError) {
  constexpr int kTrials = 200;
  constexpr int kGrain_px = 10;
  testing::Random random(11);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> white;
    for (int i = 0; i < 400 + kGrain_px; ++i) white.push_back(random.normal(0, 1.5));
    const auto ground = support_line(points_of(400,
                                               [&](double x) {
                                                 double sum = 0;
                                                 for (int k = 0; k < kGrain_px; ++k) {
                                                   sum += white[static_cast<std::size_t>(x) + k];
                                                 }
                                                 return 60 + sum / std::sqrt(kGrain_px) / 2;
                                               }),
                                     kTolerance);
    ASSERT_TRUE(ground);
    held += std::abs(ground->line.tilt_rad()) <= 1.96 * ground->deviation_rad ? 1 : 0;
  }
  EXPECT_GE(held, 0.88 * kTrials);  // the target is 95 %, the trials' 2 sigma scatter 3.1 %
}

constexpr double kGround = 150;
constexpr Base kBase{100, 300};

/// A dark heap on a plate in front of a light backdrop.
WorkingPicture heap_on_plate(double tilt_rad) {
  const double fall = std::tan(tilt_rad);
  const auto at = [&](double x, double height) {
    return cv::Point(cvRound(16 * (x - 0.5)), cvRound(16 * (kGround + fall * x - height - 0.5)));
  };
  cv::Mat3b picture(220, 400, cv::Vec3b(200, 200, 200));
  const auto paint = [&](const std::vector<cv::Point>& corners, const cv::Scalar& colour) {
    cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{corners}, colour, cv::LINE_AA, 4);
  };
  paint({at(-10, 0), at(410, 0), at(410, -100), at(-10, -100)}, {120, 130, 140});
  paint({at(kBase.from, 0), at(200, 60), at(kBase.to, 0)}, {40, 50, 60});
  return work_of(picture);
}

Ground level(double y, double slope) {
  Ground ground;
  ground.y_at_0 = y;
  ground.slope = slope;
  return ground;
}

TEST(GroundEvidence, IsLargestOnTheEdgeThatThePictureShows) {
  const double tilt = 1 * kDegree;
  const WorkingPicture work = heap_on_plate(tilt);
  const double on_edge = ground_evidence({kGround, std::tan(tilt)}, kBase, work);
  EXPECT_GT(on_edge, 0.7);
  EXPECT_LE(on_edge, 1);
  for (const auto& [y, tilt_deg] :
       {std::pair{kGround + 4, 1.0}, {kGround - 4, 1.0}, {kGround, 0.0}, {kGround, 2.0}}) {
    EXPECT_LT(ground_evidence({y, std::tan(tilt_deg * kDegree)}, kBase, work), 0.9 * on_edge);
  }
}

TEST(GroundEvidence, IsNoneOutsideThePicture) {
  EXPECT_EQ(ground_evidence({-50, 0}, kBase, heap_on_plate(0)), 0);
  EXPECT_EQ(ground_evidence({900, 0}, kBase, heap_on_plate(0)), 0);
}

TEST(BestGround, TakesTheLineThatLiesOnAnEdge) {
  const WorkingPicture work = heap_on_plate(0);
  const Ground best = best_ground(
      {level(kGround + 5, -0.02), level(kGround, 0), level(kGround + 5, 0.02)}, kBase, work);
  EXPECT_EQ(best.slope, 0);
  EXPECT_EQ(best.deviation_rad, 0) << "the others are not nearly as good";
}

TEST(BestGround, IsAsUncertainAsEquallyGoodLinesDisagree) {
  const WorkingPicture work = heap_on_plate(0);
  const Ground best = best_ground({level(kGround, 0), level(kGround + 0.4, -0.002)}, kBase, work);
  EXPECT_NEAR(best.deviation_rad, 0.002, 1e-5);
}

TEST(BestGround, SearchesForTheEdgeWhereNoLineLiesOnOne) {
  const double tilt = 1.5 * kDegree;
  const Ground best = best_ground({level(kGround + 8, 0)}, kBase, heap_on_plate(tilt));
  EXPECT_NEAR(best.tilt_rad(), tilt, 0.2 * kDegree);
  EXPECT_GE(best.deviation_rad, 0.6 * kDegree) << "half of what the search has changed";
}

TEST(BestGround, UnderABowedBaseTheSearchDoesNotTurnTheLine) {
  Ground bowed = level(kGround + 10, 0);
  bowed.bow = 0.015;
  const Ground best = best_ground({bowed}, kBase, heap_on_plate(1.5 * kDegree));
  EXPECT_EQ(best.tilt_rad(), 0);
  EXPECT_EQ(best.deviation_rad, 0);
  EXPECT_LT(best.y(300), kGround + 10) << "but shifts it";
}

/// A heap of yellow grains on a grey plate, seen from slightly above: the plate ends behind the
/// heap at kGround, and the heap's foot, which lies in shade, is 12 px lower.
WorkingPicture heap_before_an_edge(const cv::Vec3b& foot) {
  cv::Mat3b picture(220, 400, cv::Vec3b(200, 200, 200));
  picture.rowRange(static_cast<int>(kGround), 220) = cv::Vec3b(120, 120, 120);
  const std::vector<cv::Point> heap = {{100, 150}, {200, 90}, {300, 150}};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{heap}, cv::Scalar(90, 170, 200));
  cv::rectangle(picture, cv::Rect(105, 150, 190, 12), cv::Scalar(foot), cv::FILLED);
  return work_of(picture);
}

/// The outline of heap and plate taken together.
Spans spans_with_plate() {
  Spans spans{.top = std::vector<int>(400), .bottom = std::vector<int>(400, 219)};
  for (int x = 0; x < 400; ++x) {
    const double top = std::min(150.0, 90 + .6 * std::abs(x - 200));
    spans.top[static_cast<std::size_t>(x)] = static_cast<int>(top);
  }
  return spans;
}

TEST(FindGround, AnEdgeBehindTheHeapIsOneEvenIfTheGrainsBelowItLieInAShade) {
  for (const cv::Vec3b& foot :
       {cv::Vec3b(90, 170, 200), cv::Vec3b(60, 135, 160), cv::Vec3b(74, 120, 139)}) {
    const auto ground = find_ground(spans_with_plate(), heap_before_an_edge(foot));
    ASSERT_TRUE(ground);
    EXPECT_NEAR(ground->y(200), kGround, 2);
    EXPECT_TRUE(ground->behind) << "foot " << foot;
  }
}

TEST(FindGround, AHeapsShadowOnThePlateIsNoFoot) {
  const auto ground = find_ground(spans_with_plate(), heap_before_an_edge(cv::Vec3b(80, 80, 80)));
  ASSERT_TRUE(ground);
  EXPECT_FALSE(ground->behind);
}

/// A heap of yellow grains on a grey plate whose front edge lies 14 px below the heap's foot.
WorkingPicture heap_behind_an_edge() {
  cv::Mat3b picture(220, 400, cv::Vec3b(200, 200, 200));
  picture.rowRange(130, 220) = cv::Vec3b(120, 120, 120);
  picture.rowRange(static_cast<int>(kGround) + 14, 220) = cv::Vec3b(40, 40, 40);
  const std::vector<cv::Point> heap = {{100, 149}, {200, 90}, {300, 149}};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{heap}, cv::Scalar(90, 170, 200));
  return work_of(picture);
}

/// The heap's outline down to a row: to its foot, or over the plate to the plate's edge.
Spans spans_down_to(int bottom) {
  Spans spans{.top = std::vector<int>(400, -1), .bottom = std::vector<int>(400, -1)};
  for (int x = 101; x < 299; ++x) {
    spans.top[static_cast<std::size_t>(x)] = static_cast<int>(90 + .6 * std::abs(x - 200));
    spans.bottom[static_cast<std::size_t>(x)] = bottom;
  }
  return spans;
}

TEST(FindGround, AnEdgeBeforeTheHeapIsToldByTheGroundAboveIt) {
  const WorkingPicture work = heap_behind_an_edge();
  const auto edge = find_ground(spans_down_to(163), work);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->y(200), kGround + 14, 1);
  EXPECT_TRUE(edge->before);
  const auto foot = find_ground(spans_down_to(149), work);
  ASSERT_TRUE(foot);
  EXPECT_FALSE(foot->before);
}

TEST(BestGround, IsTheFootWhereTheHeapEndsAboveAPlainerEdge) {
  const WorkingPicture work = heap_behind_an_edge();
  Ground before = level(kGround + 14, 0);
  before.before = true;
  const Ground best = best_ground({before, level(kGround, 0)}, kBase, work);
  EXPECT_NEAR(best.y(200), kGround, 1);
  EXPECT_TRUE(best_ground({before}, kBase, work).before) << "no other is known";
}

TEST(BestGround, TheSearchDoesNotReachTheNextEdge) {
  // More distinct with every row: the search would follow it down to the plate's edge, 30 px lower.
  cv::Mat3b picture(220, 400, cv::Vec3b(160, 160, 160));
  for (int y = static_cast<int>(kGround); y < 220; ++y) {
    const double below = std::min(30.0, y - kGround);
    picture.row(y) = cv::Vec3b::all(static_cast<uchar>(160 - below * below / 6));
  }
  const Ground best = best_ground({level(kGround, 0)}, kBase, work_of(picture));
  EXPECT_GT(best.y(200), kGround + 3) << "it does search";
  EXPECT_NEAR(best.y(kBase.from), kGround, 6);
  EXPECT_NEAR(best.y(kBase.to), kGround, 6);
}

TEST(BestGround, IsTheFootWhereTheHeapGoesOnBelowAPlainerEdge) {
  const WorkingPicture work = heap_before_an_edge(cv::Vec3b(60, 135, 160));
  constexpr double kFoot = kGround + 12;
  Ground behind = level(kGround, 0);
  behind.behind = true;
  const Ground best = best_ground({behind, level(kFoot, 0), level(kFoot + 8, 0)}, kBase, work);
  EXPECT_FALSE(best.behind);
  EXPECT_EQ(best.y(200), kFoot);
  EXPECT_TRUE(best_ground({behind}, kBase, work).behind) << "no other is known";
  EXPECT_TRUE(best_ground({behind, level(kGround - 8, 0)}, kBase, work).behind)
      << "what is higher is no foot";
}

}  // namespace
}  // namespace repose::vision
