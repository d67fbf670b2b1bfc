#include "base/air_drag.h"

#include <cmath>
#include <utility>

#include <gmock/gmock.h>

namespace repose::base {
namespace {

constexpr double kGravity = 9.80665;

// The standard curve for spheres, by Lapple and Shepherd (1940), Ind. Eng. Chem. 32, 605, table II.
TEST(AirDrag, OfSpheresIsThatOfTheStandardCurve) {
  for (const auto& [reynolds, coefficient] :
       {std::pair{.1, 244.}, std::pair{1., 26.5}, std::pair{10., 4.1}, std::pair{100., 1.07},
        std::pair{1000., .46}, std::pair{5000., .385}}) {
    EXPECT_NEAR(drag_coefficient(reynolds, 1) / coefficient, 1, .15) << reynolds;
    if (reynolds <= 1000) {
      EXPECT_NEAR(drag_coefficient(reynolds, 1) / coefficient, 1, .05) << reynolds;
    }
  }
}

// Cubes, sphericity .806, have a coefficient of about 1.2 at a Reynolds number of 1000 (Pettyjohn
// and Christiansen 1948, Chem. Eng. Prog. 44, 157: settling factors of isometric particles, from
// whose tables K2 = 5.31 - 4.88 phi = 1.38 in Newton's range).
TEST(AirDrag, OfOtherGrainsGrowsAsTheyAreLessRound) {
  EXPECT_NEAR(drag_coefficient(2000, .806), 1.3, .25);
  EXPECT_GT(drag_coefficient(1000, .9), 1.2 * drag_coefficient(1000, 1));
  EXPECT_NEAR(drag_coefficient(100, .9989), drag_coefficient(100, 1),
              .01 * drag_coefficient(100, 1));
}

// v = (q - p) g d^2 / (18 eta), independent of the height.
TEST(AirDrag, LetsDustFallAsStokesSays) {
  const FallingGrain dust{.diameter_m = 1e-5, .density_kg_m3 = 1000};
  const double stokes = (1000 - 1.204) * kGravity * 1e-10 / (18 * 1.82e-5);
  EXPECT_NEAR(speed_after_fall_m_s(dust, .01) / stokes, 1, .01);
  EXPECT_NEAR(speed_after_fall_m_s(dust, 100) / stokes, 1, .01);
}

// With a constant coefficient v^2 = (g / k) (1 - exp(-2 k z)), k = 3 Cd p / (4 q d), and on the way
// up v^2 = (g / k) (exp(2 k z) - 1).
TEST(AirDrag, SlowsLargeBallsAsTheClosedFormSays) {
  const FallingGrain ball{.diameter_m = .05, .density_kg_m3 = 200};
  const double k = .75 * .44 * 1.204 / (200 * .05);
  const double g = kGravity * (1 - 1.204 / 200);
  EXPECT_NEAR(std::pow(speed_after_fall_m_s(ball, 10), 2) / (g / k * -std::expm1(-20 * k)), 1,
              2e-4);
  EXPECT_NEAR(std::pow(speed_before_rise_m_s(ball, 10), 2) / (g / k * std::expm1(20 * k)), 1, 2e-4);
}

TEST(AirDrag, LeavesHeavyBallsAlone) {
  const FallingGrain steel{.diameter_m = .02, .density_kg_m3 = 7850};
  EXPECT_NEAR(rise_without_air_m(steel, .5, .125), .125, 2e-3 * .125);
  EXPECT_EQ(rise_without_air_m(steel, .5, 0), 0);
}

// Rapeseeds of e = .5 that fall 500 mm rise to .458^2 of it, by an independent integration.
TEST(AirDrag, IsTakenOutOfRapeseedsRebounds) {
  const FallingGrain seed{.diameter_m = .002, .density_kg_m3 = 1100};
  EXPECT_NEAR(std::sqrt(rise_without_air_m(seed, .5, .458 * .458 * .5) / .5), .5, 5e-4);
}

}  // namespace
}  // namespace repose::base
