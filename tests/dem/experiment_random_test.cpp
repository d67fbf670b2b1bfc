#include <gtest/gtest.h>

#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

TEST(Random, GivesTheSameNumbersEverywhere) {
  // The engine's 10000th number is fixed by the standard ([rand.predef]); ours are its top 53 bits.
  Random random(5489);
  double last = 0;
  for (int k = 0; k < 10000; ++k) last = random.uniform();
  EXPECT_EQ(last, static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

TEST(Random, OtherSeedsGiveOtherPoses) {
  EXPECT_NE(Random(1).orientation().coeffs(), Random(2).orientation().coeffs());
  EXPECT_EQ(Random(1).orientation().coeffs(), Random(1).orientation().coeffs());
}

TEST(Random, NumbersLieBetweenTheirBounds) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const double value = random.between(-2, 5);
    ASSERT_GE(value, -2);
    ASSERT_LT(value, 5);
  }
}

TEST(Random, OrientationsFavourNoDirection) {
  Random random(7);
  constexpr int kCount = 20000;
  Vector mean = Vector::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double turned = 0;
  for (int k = 0; k < kCount; ++k) {
    const Quaternion orientation = random.orientation();
    ASSERT_NEAR(orientation.norm(), 1, 1e-14);
    const Vector axis = orientation * Vector(0, .6, .8);
    mean += axis / kCount;
    spread += axis * axis.transpose() / kCount;
    turned += orientation.w() * orientation.w() / kCount;
  }
  // Standard errors: 1 / sqrt(3 N) = .004 of a mean, .0021 of a mean square; limits are four.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), .017);
  EXPECT_LT((spread - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), .009);
  EXPECT_NEAR(turned, .25, .009);
}

}  // namespace
}  // namespace repose::dem
