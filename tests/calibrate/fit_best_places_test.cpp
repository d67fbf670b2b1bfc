#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/fit/best_places.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {
namespace {

/// Trained only where x < .5.
Surrogate half_known(bool is_stochastic) {
  TrainingSet training_set{{0}, is_stochastic, {}, {}};
  Random luck(1);
  for (int i = 0; i < 20; ++i) {
    const double x = .5 * i / 19.;
    training_set.places.push_back({x});
    training_set.readings.push_back(std::sin(6 * x) + (is_stochastic ? .1 * luck.normal() : 0));
  }
  return {training_set, {}, false};
}

std::vector<Point> candidates() {
  std::vector<Point> points;
  for (int i = 0; i <= 20; ++i) points.push_back({i / 20.});
  return points;
}

TEST(BestPlaces, GoWhereLeastIsKnown) {
  const std::vector<Point> all = candidates();
  for (const std::size_t i : best_places({half_known(true)}, {1}, all, 3)) {
    EXPECT_GT(all[i][0], .55);
  }
}

TEST(BestPlaces, WithoutChanceNoneIsRunTwice) {
  const std::vector<Point> all = candidates();
  std::vector<std::size_t> chosen = best_places({half_known(false)}, {1}, all, 5);
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(std::adjacent_find(chosen.begin(), chosen.end()), chosen.end());
}

TEST(BestPlaces, HeavierSurrogatesDecide) {
  TrainingSet other{{0}, true, {}, {}};
  Random luck(2);
  for (int i = 0; i < 20; ++i) {
    other.places.push_back({.5 + .5 * i / 19.});
    other.readings.push_back(std::sin(6 * other.places.back()[0]) + .1 * luck.normal());
  }
  const std::vector<Surrogate> both = {half_known(true), Surrogate(other, {}, false)};
  const std::vector<Point> all = candidates();
  EXPECT_GT(all[best_places(both, {1, 1e-6}, all, 1)[0]][0], .55);
  EXPECT_LT(all[best_places(both, {1e-6, 1}, all, 1)[0]][0], .45);
}

TEST(BestPlaces, OneThatIsNotAcceptedMakesRoomForTheNext) {
  const std::vector<Point> all = candidates();
  const auto accepts = [&](std::size_t i) { return all[i][0] < .9; };
  const std::vector<std::size_t> chosen = best_places({half_known(true)}, {1}, all, 4, 0, accepts);
  ASSERT_EQ(chosen.size(), 4U);
  for (const std::size_t i : chosen) EXPECT_LT(all[i][0], .9);
  const auto none = [](std::size_t) { return false; };
  EXPECT_THAT(best_places({half_known(true)}, {1}, all, 4, 0, none), ::testing::IsEmpty());
}

}  // namespace
}  // namespace repose::calibrate
