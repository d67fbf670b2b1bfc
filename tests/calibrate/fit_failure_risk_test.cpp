#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/fit/misfit.h"

namespace repose::calibrate {
namespace {

TEST(FailureRisk, IsHighAmongFailuresLowAmongSuccessesAndNoneFarAway) {
  const FailureRisk risk({{0}, {{.1}, {.15}, {.5}, {.55}}, {true, true, false, false}});
  EXPECT_GT(risk.at({.12}).fraction, .9);
  EXPECT_LT(risk.at({.52}).fraction, .1);
  EXPECT_LT(risk.at({1.}).fraction, .01);
  EXPECT_LT(risk.at({.3}).gradient[0], 0);
}

TEST(FailureRisk, IsNoneWithoutFailures) {
  const FailureRisk risk({{0}, {{.1}, {.5}}, {false, false}});
  EXPECT_FALSE(risk.any());
  EXPECT_EQ(risk.at({.1}).fraction, 0);
}

TEST(FailureRisk, ARunTellsOfItsNeighboursByANormalDensity) {
  const FailureRisk risk({{0, 2}, {}, {}});
  EXPECT_EQ(risk.nearness({.5, .1, .5}, {.5, .9, .5}), 1) << "what it does not depend on";
  EXPECT_NEAR(risk.nearness({.5, .1, .5}, {.6, .1, .6}), std::exp(-.5), 1e-12);
}

}  // namespace
}  // namespace repose::calibrate
