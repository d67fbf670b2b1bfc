#include "dem/contact/adhesion.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

double ball_m3(double diameter_m) { return std::numbers::pi / 6 * std::pow(diameter_m, 3); }

TEST(Adhesion, IsPullOffForceByWeight) {
  constexpr double kDiameter_m = 1e-4, kDensity = 2500, kAdhesion = 1e-3;
  const double pull_off = 1.5 * std::numbers::pi * kAdhesion * kDiameter_m / 4;
  const double weight = ball_m3(kDiameter_m) * kDensity * 9.80665;
  EXPECT_NEAR(bond_number(kDiameter_m, kDensity, kAdhesion), pull_off / weight, 1e-12);
}

// Dry powders become cohesive at about 0.1 mm (Visser 1989, Powder Technology 58, 1; group C of
// Geldart 1973, Powder Technology 7, 285, below some 0.03 mm); sand of half a millimetre, seeds and
// beads flow freely.
TEST(Adhesion, IsSaidOfPowdersAndNotOfGrains) {
  EXPECT_THAT(adhesion_warning(ball_m3(5e-5), 1000).value_or(""),
              AllOf(HasSubstr("grains of 0.05 mm and 1000 kg/m3 would stick"),
                    HasSubstr("5.5 to 55"), HasSubstr("not measured")));
  EXPECT_THAT(adhesion_warning(ball_m3(2e-4), 1500).value_or(""), HasSubstr("may stick"));
  EXPECT_FALSE(adhesion_warning(ball_m3(5e-4), 2600));
  EXPECT_FALSE(adhesion_warning(ball_m3(2e-3), 1100));
}

}  // namespace
}  // namespace repose::dem
