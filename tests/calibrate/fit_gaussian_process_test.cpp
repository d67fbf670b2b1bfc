#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/fit/gaussian_process.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {
namespace {

double curve(const Point& x) { return std::sin(4 * x[0]) + x[1] * x[1]; }

struct Data {
  std::vector<Point> places;
  std::vector<double> values;
};

Data noisy(std::size_t count, double noise) {
  Data data;
  Random random(5);
  for (std::size_t i = 0; i < count; ++i) {
    data.places.push_back(sequence_point(i, 3));  // the third has no effect
    data.values.push_back(curve(data.places.back()) + noise * random.normal());
  }
  return data;
}

TEST(GaussianProcess, LearnsASmoothFunctionAndWhatHasNoEffect) {
  const Data data = noisy(60, 0);
  const GaussianProcess process(data.places, data.values, false, {}, 2);
  const Point here = {.31, .62, .77};
  EXPECT_NEAR(process.at(here, false).mean, curve(here), .02);
  const std::vector<double> length = process.hyperparameters().length;
  EXPECT_GT(length[2], 3 * length[0]);
}

TEST(GaussianProcess, FindsTheNoise) {
  const Data data = noisy(120, .2);
  EXPECT_NEAR(GaussianProcess(data.places, data.values, true, {}, 2).noise_sd(), .2, .04);
}

TEST(GaussianProcess, GradientsAreThoseOfItsValues) {
  const Data data = noisy(30, .1);
  const GaussianProcess process(data.places, data.values, true, {}, 1);
  const Point here = {.4, .3, .6};
  const Expectation at = process.at(here, true);
  for (std::size_t c = 0; c < here.size(); ++c) {
    constexpr double kStep = 1e-5;
    Point up = here;
    Point down = here;
    up[c] += kStep;
    down[c] -= kStep;
    const Expectation above = process.at(up, false);
    const Expectation below = process.at(down, false);
    EXPECT_NEAR(at.mean_gradient[c], (above.mean - below.mean) / (2 * kStep), 1e-5) << c;
    EXPECT_NEAR(at.variance_gradient[c], (above.variance - below.variance) / (2 * kStep), 1e-5)
        << c;
  }
}

TEST(GaussianProcess, LeavingOneOutIsTheSameAsNotHavingIt) {
  Data data = noisy(25, .1);
  const GaussianProcess all(data.places, data.values, true, {}, 1);
  const LeaveOneOut last = all.leave_one_out().back();
  // Prediction of the last value from the others, worked out from the posterior covariance of all.
  const std::vector<double> posterior = all.covariance({data.places.back()});
  const double noise2 = all.noise_sd() * all.noise_sd();
  const double latent2 = posterior[0];
  // var_with = 1 / (1 / var_without + 1 / noise2), solved for var_without.
  const double without2 = 1 / (1 / latent2 - 1 / noise2);
  EXPECT_NEAR(last.sd * last.sd, without2 + noise2, 1e-6 * last.sd);
}

/// An almost unknown value changes almost nothing; the same value treated as certain does.
TEST(GaussianProcess, UncertainValuesCountLess) {
  const Data data = noisy(30, 0);
  Data with_wrong = data;
  const Point place = {.41, .52, .5};
  const GaussianProcess without(data.places, data.values, true, {}, 1);
  with_wrong.places.push_back(place);
  with_wrong.values.push_back(without.at(place, false).mean + 1.5);
  MeansOfRuns told;
  told.own_variances.assign(with_wrong.values.size(), 0);
  told.own_variances.back() = 1e4;
  const GaussianProcess unsure(with_wrong.places, with_wrong.values, true, {}, 1, told);
  const GaussianProcess sure(with_wrong.places, with_wrong.values, true, {}, 1);
  const double expected = without.at(place, false).mean;
  EXPECT_NEAR(unsure.at(place, false).mean, expected, .02);
  EXPECT_GT(std::abs(sure.at(place, false).mean - expected), .1);
  EXPECT_GT(unsure.leave_one_out().back().sd, 50);
  // The same variance for all: the fitted noise is the remainder.
  const Data scattered = noisy(60, .2);
  told.own_variances.assign(scattered.values.size(), .04);
  const GaussianProcess rest(scattered.places, scattered.values, true, {}, 2, told);
  EXPECT_LT(rest.noise_sd(), .1);
}

/// With normal noise, mean, number and sum of squares are sufficient statistics of the runs.
TEST(GaussianProcess, LearnsFromMeansAndTheirScatterWhatTheRunsThemselvesTell) {
  constexpr std::size_t kPlaces = 30;
  constexpr int kRepeats = 3;
  constexpr double kNoise = .2;
  Random random(8);
  Data runs, means;
  MeansOfRuns told;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const Point place = sequence_point(i, 2);
    double mean = 0, squares = 0;
    std::vector<double> here;
    for (int k = 0; k < kRepeats; ++k) here.push_back(curve(place) + kNoise * random.normal());
    for (const double value : here) mean += value / kRepeats;
    for (const double value : here) squares += (value - mean) * (value - mean);
    for (const double value : here) {
      runs.places.push_back(place);
      runs.values.push_back(value);
    }
    means.places.push_back(place);
    means.values.push_back(mean);
    told.counts.push_back(kRepeats);
    told.squares += squares;
    told.df += kRepeats - 1;
  }
  const GaussianProcess of_runs(runs.places, runs.values, true, {}, 2);
  const GaussianProcess of_means(means.places, means.values, true, {}, 2, told);
  EXPECT_NEAR(of_means.noise_sd(), of_runs.noise_sd(), .01 * kNoise);
  for (const Point& here : {Point{.5, .5}, Point{.13, .88}, Point{.97, .02}}) {
    const Expectation one = of_means.at(here, false), other = of_runs.at(here, false);
    EXPECT_NEAR(one.mean, other.mean, .05 * kNoise);
    EXPECT_NEAR(std::sqrt(one.variance), std::sqrt(other.variance),
                .05 * std::sqrt(other.variance));
  }
  // If treated as single runs, the means would hide most of the noise.
  const GaussianProcess of_singles(means.places, means.values, true, {}, 2);
  EXPECT_LT(of_singles.noise_sd(), .8 * kNoise);
}

}  // namespace
}  // namespace repose::calibrate
