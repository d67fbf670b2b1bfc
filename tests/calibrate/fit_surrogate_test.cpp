#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {
namespace {

TEST(AsinhWarp, ExpectationAndScatterAreThoseOfManyReadings) {
  const AsinhWarp warp{3, .5};
  const double w = warp.of_expected(20);
  EXPECT_NEAR(warp.expected(w), 20, 1e-9);
  Random random(1);
  constexpr int kCount = 200000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double y = 3 * std::sinh(w + .5 * random.normal());
    sum += y;
    squares += y * y;
  }
  EXPECT_NEAR(sum / kCount, 20, .1);
  EXPECT_NEAR(warp.scatter(w), std::sqrt(squares / kCount - 400), .15);
}

TEST(AsinhWarp, SlopeIsThatOfTheExpectation) {
  const AsinhWarp warp{3, .5};
  EXPECT_NEAR(warp.slope(1.2), (warp.expected(1.2001) - warp.expected(1.1999)) / .0002, 1e-5);
}

TrainingSet training_set(std::size_t count, double (*reading)(const Point&, Random&)) {
  TrainingSet training_set{{1}, true, {}, {}};  // the second of three parameters
  Random random(3);
  for (std::size_t i = 0; i < count; ++i) {
    training_set.places.push_back(sequence_point(i, 1));
    training_set.readings.push_back(reading(training_set.places.back(), random));
  }
  return training_set;
}

double heavy_tailed(const Point& x, Random& random) {
  return 100 * std::exp(3 * x[0]) * std::exp(.4 * random.normal() - .08);
}

TEST(Surrogate, BendsWhatSpansManyScalesAndStillGivesTheMean) {
  const Surrogate surrogate(training_set(150, heavy_tailed), {}, true);
  EXPECT_GT(surrogate.warp().warp, 0);
  const double truth = 100 * std::exp(1.5);
  EXPECT_NEAR(surrogate.simulated({.9, .5, .1}), truth, .12 * truth);
  EXPECT_NEAR(surrogate.warp().scatter(surrogate.at({0, .5, 0}, false).mean), .416 * truth,
              .1 * truth);
}

TEST(Surrogate, DoesNotGoBelowZeroWhereNoRunDid) {
  const Surrogate surrogate(
      training_set(40, [](const Point& x,
                          Random&) { return std::max(0., x[0] - .5) * std::max(0., x[0] - .5); }),
      {}, true);
  for (double x = 0; x <= 1; x += .05) EXPECT_GE(surrogate.simulated({0, x, 0}), 0);
}

TEST(Surrogate, OnlyItsOwnParametersCount) {
  const Surrogate surrogate(training_set(50, heavy_tailed), {}, false);
  const Expectation at = surrogate.at({.1, .4, .9}, true);
  EXPECT_EQ(at.mean_gradient[0], 0);
  EXPECT_NE(at.mean_gradient[1], 0);
  EXPECT_EQ(at.variance_gradient[2], 0);
  EXPECT_EQ(at.mean, surrogate.at({.8, .4, .2}, false).mean);
}

TEST(Surrogate, IsLessSureWhereRunsScatterMoreThanElsewhere) {
  // Little noise over nine tenths of the range, much near the end.
  Surrogate surrogate(training_set(100,
                                   [](const Point& x, Random& random) {
                                     return x[0] + (x[0] > .9 ? 1. : .05) * random.normal();
                                   }),
                      {}, true);
  surrogate.inflate_near({0, .3, 0});
  const double calm = surrogate.inflation();
  surrogate.inflate_near({0, .97, 0});
  EXPECT_GT(surrogate.inflation(), 1.5);
  EXPECT_GT(surrogate.inflation(), 1.3 * calm);
}

TEST(Surrogate, NoiseKnownFromFewRunsCountsAsStudentSays) {
  const auto noisy = [](const Point& x, Random& random) { return x[0] + .3 * random.normal(); };
  const double few = Surrogate(training_set(8, noisy), {}, true).few_runs_factor();
  const double many = Surrogate(training_set(100, noisy), {}, true).few_runs_factor();
  EXPECT_GT(few, 1.15);  // at most 8 degrees of freedom: 2.306 / 1.960
  EXPECT_LT(few, 1.63);
  EXPECT_GT(many, 1.01);
  EXPECT_LT(many, 1.02);
  TrainingSet sure = training_set(8, noisy);
  sure.is_stochastic = false;
  EXPECT_EQ(Surrogate(sure, {}, true).few_runs_factor(), 1);
}

TEST(Surrogate, AConstantIsCalledOne) {
  const Surrogate surrogate(training_set(10, [](const Point&, Random&) { return 7.; }), {}, true);
  EXPECT_TRUE(surrogate.constant());
  EXPECT_EQ(surrogate.simulated({0, .3, 0}), 7);
  EXPECT_EQ(surrogate.uncertainty({0, .3, 0}), 0);
}

}  // namespace
}  // namespace repose::calibrate
