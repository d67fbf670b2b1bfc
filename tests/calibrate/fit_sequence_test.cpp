#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/fit/points.h"

namespace repose::calibrate {
namespace {

TEST(Sequence, IsTheGoldenOneInOneDimension) {
  const double golden = (std::sqrt(5) - 1) / 2;
  EXPECT_NEAR(sequence_point(0, 1)[0], .5 + golden - 1, 1e-12);
  EXPECT_NEAR(sequence_point(1, 1)[0], .5 + 2 * golden - 1, 1e-12);
}

TEST(Sequence, AnyStretchOfItFillsACubeAndKeepsItsPointsApart) {
  for (const std::size_t begin : {0, 137}) {
    std::vector<int> counts(8, 0);
    std::vector<Point> points;
    double least = 1;
    for (std::size_t i = begin; i < begin + 64; ++i) {
      const Point x = sequence_point(i, 3);
      ++counts[(x[0] < .5 ? 0U : 1U) + (x[1] < .5 ? 0U : 2U) + (x[2] < .5 ? 0U : 4U)];
      for (const Point& other : points) {
        least = std::min(least, std::hypot(x[0] - other[0], x[1] - other[1], x[2] - other[2]));
      }
      points.push_back(x);
    }
    EXPECT_THAT(counts, ::testing::Each(::testing::Ge(4)));
    EXPECT_GT(least, .15);  // random points come as close as .03
  }
}

TEST(UnitBox, ThereAndBackIsTheSameInDecimals) {
  Problem problem;
  problem.parameters = {{"a", .01, .41, {}}, {"b", -3000, 5000, {}}};
  EXPECT_EQ(to_values(problem, to_unit(problem, {.1234567, 17.25})),
            (std::vector<double>{.1234567, 17.25}));
  EXPECT_EQ(rounded(problem.parameters[0], .123456789), .1234568);
  EXPECT_EQ(rounded(problem.parameters[0], .5), .41);
}

TEST(UnitBox, WhatHasNoEffectDoesNotTellJobsApart) {
  Problem problem;
  problem.parameters = {{"a", 0, 1, {}}, {"b", 0, 4, {}}};
  problem.experiments = {{"tilt", {0}, 1, false, {}}};
  const Experiment& tilt = problem.experiments.front();
  EXPECT_EQ(job_at(problem, tilt, {.25, .1}, 4), job_at(problem, tilt, {.25, .9}, 5));
  EXPECT_EQ(job_at(problem, tilt, {.25, .1}, 4).values, (std::vector<double>{.25, 2}));
}

}  // namespace
}  // namespace repose::calibrate
