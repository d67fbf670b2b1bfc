#include <gmock/gmock.h>

#include "calibrate/export/rolling.h"
#include "calibrate/export/target_entry.h"
#include "tests/dem/experiment_model.h"

namespace repose::calibrate {
namespace {

using dem::RollingModel;

const dem::ClumpShape kSphere = dem::sphere_shape(.01);

RollingConversion sphere(ExportTarget target, RollingModel model, Partner partner) {
  return convert_rolling(target, model, partner, kSphere);
}

TEST(ArmRatio, IsOneForASphereAndLongerForAClump) {
  for (const Partner partner : {Partner::wall, Partner::grain}) {
    const ArmRatio ball = arm_ratio(kSphere, partner);
    EXPECT_NEAR(ball.mean, 1, 1e-12);
    EXPECT_NEAR(ball.low, 1, 1e-12);
    EXPECT_NEAR(ball.high, 1, 1e-12);
  }
}

// Two spheres of radius R at +-R on the long axis: lying, they touch a wall at sqrt(2) R; upright,
// at 2 R. In a direction at cosine u to the axis, r^2 = R^2 (2 + 2 u), u being uniform over 0 ...
// 1: the mean of r / R is sqrt(2) (2/3) (2 sqrt(2) - 1).
TEST(ArmRatio, OfTwoTouchingSpheresIsThatOfTheirGeometry) {
  dem::ClumpShape pair;
  pair.spheres = {{.centre = {.01, 0, 0}, .radius = .01}, {.centre = {-.01, 0, 0}, .radius = .01}};
  pair.gyration_m2 = {1e-5, 3e-5, 3e-5};
  const ArmRatio lying = arm_ratio(pair, Partner::wall);
  EXPECT_NEAR(lying.mean, std::sqrt(2), 1e-9);
  EXPECT_NEAR(lying.low, lying.high, 1e-9);
  const ArmRatio any = arm_ratio(pair, Partner::grain);
  EXPECT_NEAR(any.mean, std::sqrt(2) * 2 / 3 * (2 * std::sqrt(2) - 1), 1e-4);
  EXPECT_NEAR(any.low, std::sqrt(2), 1e-3);
  EXPECT_NEAR(any.high, 2, 1e-3);
}

TEST(ConvertRolling, LiggghtsHasTwoOfOurModels) {
  for (const Partner partner : {Partner::wall, Partner::grain}) {
    for (const RollingModel model :
         {RollingModel::relative_constant_torque, RollingModel::elastic_plastic}) {
      for (const dem::ClumpShape& grain : {kSphere, dem::test::spheroid_clump(3)}) {
        const auto converted = convert_rolling(liggghts_target(), model, partner, grain);
        EXPECT_EQ(converted.factor, 1);
        EXPECT_EQ(converted.fidelity, Fidelity::exact);
      }
    }
  }
}

TEST(ConvertRolling, ConstantTorqueIsLiggghtssOnAWallAndDoubleBetweenSpheres) {
  const auto wall = sphere(liggghts_target(), RollingModel::constant_torque, Partner::wall);
  EXPECT_NEAR(wall.factor, 1, 1e-12);
  EXPECT_EQ(wall.fidelity, Fidelity::exact);
  const auto grain = sphere(liggghts_target(), RollingModel::constant_torque, Partner::grain);
  EXPECT_NEAR(grain.factor, 2, 1e-12);
  EXPECT_EQ(grain.fidelity, Fidelity::approximate);
  EXPECT_THAT(grain.limits, ::testing::HasSubstr("own spin"));
}

TEST(ConvertRolling, OwnSpinOfAClumpIsApproximate) {
  const dem::ClumpShape clump = dem::test::spheroid_clump(3);
  const auto wall =
      convert_rolling(liggghts_target(), RollingModel::constant_torque, Partner::wall, clump);
  EXPECT_EQ(wall.fidelity, Fidelity::approximate);
  EXPECT_NEAR(wall.factor, arm_ratio(clump, Partner::wall).mean, 1e-12);
  EXPECT_THAT(wall.limits, ::testing::HasSubstr("lever"));
}

// Standard: mu_r F r against each body's own spin; RVD: mu_r F R* against the relative spin; Type
// C: a spring up to mu_r F R*.
TEST(ConvertRolling, EdemHasAllThreeOfOurModels) {
  using ::testing::HasSubstr;
  for (const dem::ClumpShape& grain : {kSphere, dem::test::spheroid_clump(3)}) {
    for (const Partner partner : {Partner::wall, Partner::grain}) {
      for (const RollingModel model :
           {RollingModel::constant_torque, RollingModel::relative_constant_torque,
            RollingModel::elastic_plastic}) {
        const auto converted = convert_rolling(edem_target(), model, partner, grain);
        EXPECT_EQ(converted.factor, 1);
        EXPECT_NE(converted.fidelity, Fidelity::approximate);
      }
    }
  }
  const auto edem = [](RollingModel model, Partner partner) {
    return sphere(edem_target(), model, partner);
  };
  EXPECT_EQ(edem(RollingModel::relative_constant_torque, Partner::wall).fidelity, Fidelity::exact);
  EXPECT_THAT(edem(RollingModel::relative_constant_torque, Partner::grain).limits,
              HasSubstr("half the sum of both spins"));
  EXPECT_EQ(edem(RollingModel::elastic_plastic, Partner::wall).fidelity, Fidelity::close);
  EXPECT_THAT(edem_target()->rolling_law(RollingModel::constant_torque), HasSubstr("standard"));
  EXPECT_THAT(edem_target()->rolling_law(RollingModel::relative_constant_torque), HasSubstr("RVD"));
  EXPECT_THAT(edem_target()->rolling_law(RollingModel::elastic_plastic), HasSubstr("Type C"));
}

// YADE's lever of mu_r F is (R1 + R2) / 2; ours is R*: R on a wall, R / 2 between equal spheres.
TEST(ConvertRolling, LeversOfOtherProgramsAreTakenOut) {
  const auto factor = [](ExportTarget target, Partner partner) {
    return sphere(target, RollingModel::elastic_plastic, partner).factor;
  };
  EXPECT_NEAR(factor(yade_target(), Partner::wall), 1, 1e-12);
  EXPECT_NEAR(factor(yade_target(), Partner::grain), .5, 1e-12);
  EXPECT_NEAR(factor(lammps_target(), Partner::grain), 1, 1e-12);
}

TEST(ConvertRolling, SpringsThatYieldAreCloseAndUnequalRadiiAreNot) {
  const auto wall = sphere(yade_target(), RollingModel::elastic_plastic, Partner::wall);
  EXPECT_EQ(wall.fidelity, Fidelity::close);
  const auto clump = convert_rolling(yade_target(), RollingModel::elastic_plastic, Partner::grain,
                                     dem::test::spheroid_clump(3));
  EXPECT_EQ(clump.fidelity, Fidelity::approximate);
}

TEST(ConvertRolling, WithoutAModelNothingIsConverted) {
  for (const ExportTarget target : export_targets()) {
    const auto none = convert_rolling(target, RollingModel::none, Partner::grain, kSphere);
    EXPECT_EQ(none.fidelity, Fidelity::exact) << name_of(target);
    EXPECT_EQ(none.factor, 1) << name_of(target);
  }
}

}  // namespace
}  // namespace repose::calibrate
