#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/heap_random.h"
#include "vision/compare/skyline.h"

namespace repose::vision {
namespace {

TEST(EdgeDistance, OfAnEdgeToItselfIsNothing) {
  const Skyline edge = {{-3, 0.1}, {-1, 2}, {0.5, 1.7}, {2, 0}};
  EXPECT_NEAR(edge_distance(edge, edge).largest, 0, 1e-12);
}

TEST(EdgeDistance, OfParallelLinesIsTheirGap) {
  const EdgeDistance d = edge_distance({{0, 1}, {10, 1}}, {{0, 3}, {10, 3}});
  EXPECT_NEAR(d.largest, 2, 1e-12);
  EXPECT_NEAR(d.most_of_it, 2, 1e-12);
}

TEST(EdgeDistance, IsTakenAtRightAnglesToASlope) {
  // Two lines of slope 1, one 1 higher: 1 / sqrt(2) apart, except at the ends.
  const EdgeDistance d = edge_distance({{0, 0}, {100, 100}}, {{0, 1}, {100, 101}});
  EXPECT_NEAR(d.most_of_it, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(d.largest, 1, 1e-9) << "at the ends";
}

TEST(EdgeDistance, ASingleStrayCountsInTheLargestOnly) {
  const EdgeDistance d =
      edge_distance({{0, 0}, {100, 0}}, {{0, 0}, {49.9, 0}, {50, 1}, {50.1, 0}, {100, 0}});
  EXPECT_NEAR(d.largest, 1, 0.06);  // a 2,000th of the edge is .05 long
  EXPECT_LT(d.most_of_it, 1e-9);
}

TEST(EdgeDistance, LooksBothWays) {
  const Skyline longer = {{0, 0}, {10, 0}};
  const Skyline shorter = {{0, 0}, {4, 0}};
  EXPECT_NEAR(edge_distance(longer, shorter).largest, 6, 1e-12);
  EXPECT_NEAR(edge_distance(shorter, longer).largest, 6, 1e-12);
}

/// To the nearest of many points of the edge, by brute force.
double slow_distance(const OutlinePoint& from, const Skyline& edge) {
  double nearest = std::hypot(edge[0].along - from.along, edge[0].height - from.height);
  for (std::size_t i = 1; i < edge.size(); ++i) {
    for (double t = 0; t <= 1; t += 0.01) {
      const double along = edge[i - 1].along + t * (edge[i].along - edge[i - 1].along);
      const double height = edge[i - 1].height + t * (edge[i].height - edge[i - 1].height);
      nearest = std::min(nearest, std::hypot(along - from.along, height - from.height));
    }
  }
  return nearest;
}

TEST(EdgeDistance, IsThatOfTheNearestPointWhereverItLies) {
  testing::Random random(5);
  for (int round = 0; round < 30; ++round) {
    Skyline teeth;
    for (int i = 0; i < 20; ++i) {
      teeth.push_back({i + random.uniform(0, 0.9), random.uniform(0, 10)});
    }
    const OutlinePoint lone = {random.uniform(-5, 25), random.uniform(0, 12)};
    // From the lone point, the distance is that of the nearest tooth; from the teeth, the farthest.
    double farthest = 0;
    for (const OutlinePoint& tooth : teeth) {
      farthest =
          std::max(farthest, std::hypot(tooth.along - lone.along, tooth.height - lone.height));
    }
    EXPECT_NEAR(edge_distance({lone}, teeth).largest, farthest, 0.1);
    Skyline with_lone = teeth;
    if (lone.along <= teeth.back().along) continue;
    with_lone.push_back(lone);
    EXPECT_NEAR(edge_distance(with_lone, teeth).largest, slow_distance(lone, teeth), 0.05);
  }
}

TEST(EdgeDistance, OfTwoPointsIsTheirs) {
  EXPECT_NEAR(edge_distance({{3, 5}}, {{3.001, 5}}).largest, 0.001, 1e-12);
}

}  // namespace
}  // namespace repose::vision
