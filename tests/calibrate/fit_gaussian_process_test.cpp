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
  // Prediction of the last value from the others, written out with the covariances of all.
  const std::vector<double> posterior = all.covariance({data.places.back()});
  const double noise2 = all.noise_sd() * all.noise_sd();
  const double latent2 = posterior[0];
  // var_with = 1 / (1 / var_without + 1 / noise2), solved for var_without.
  const double without2 = 1 / (1 / latent2 - 1 / noise2);
  EXPECT_NEAR(last.sd * last.sd, without2 + noise2, 1e-6 * last.sd);
}

}  // namespace
}  // namespace repose::calibrate
