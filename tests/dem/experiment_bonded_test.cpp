#include <algorithm>

#include <gtest/gtest.h>

#include "dem/experiment/model_setup.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

TEST(Bonded, TwoSpheresTurnLikeADumbbell) {
  const double r = .01;
  const ClumpShape pair = bonded_shape(sphere_shape(r), 2);
  EXPECT_DOUBLE_EQ(pair.volume_m3, 2 * sphere_shape(r).volume_m3);
  // Steiner: .4 r^2 along the row, .4 r^2 + r^2 across it.
  Vector moments = pair.gyration_m2 / (r * r);
  std::sort(moments.begin(), moments.end());
  EXPECT_NEAR(moments[0], .4, 1e-12);
  EXPECT_NEAR(moments[1], 1.4, 1e-12);
  EXPECT_NEAR(moments[2], 1.4, 1e-12);
}

TEST(Bonded, OneGrainStaysWhatItIs) {
  const ClumpShape grain = test::spheroid_clump(5);
  const ClumpShape body = bonded_shape(grain, 1);
  ASSERT_EQ(body.spheres.size(), grain.spheres.size());
  for (std::size_t k = 0; k < grain.spheres.size(); ++k) {
    EXPECT_EQ(body.spheres[k].centre, grain.spheres[k].centre);
  }
  EXPECT_EQ(body.gyration_m2, grain.gyration_m2);
}

TEST(Bonded, GrainsTouchAndLieSideBySide) {
  const ClumpShape grain = test::spheroid_clump(11);
  const ClumpShape body = bonded_shape(grain, 3);
  const Quaternion lying = lying_pose(grain);
  double gap = 1;
  for (std::size_t a = 0; a < 11; ++a) {
    for (std::size_t b = 11; b < 22; ++b) {
      const ClumpSphere& one = body.spheres[a];
      const ClumpSphere& other = body.spheres[b];
      gap = std::min(gap, (one.centre - other.centre).norm() - one.radius - other.radius);
    }
  }
  EXPECT_NEAR(gap, 0, 1e-12);
  // The row is horizontal, perpendicular to the long axes, and centred on the centre of mass.
  const Vector row = lying * (body.spheres[27].centre - body.spheres[5].centre);
  EXPECT_NEAR(row.x(), 4 * 8.92e-3, 1e-12);
  EXPECT_NEAR(row.y(), 0, 1e-12);
  EXPECT_NEAR(row.z(), 0, 1e-12);
  Vector middle = Vector::Zero();
  for (const ClumpSphere& sphere : body.spheres) middle += sphere.centre / 33;
  EXPECT_LT(middle.norm(), 1e-12);
}

TEST(Placing, GrainsLieOnTheirFlatSide) {
  ClumpShape grain = sphere_shape(.01);
  for (const Vector& gyration :
       {Vector(1, 2, 3), Vector(3, 2, 1), Vector(2, 3, 1), Vector(1, 3, 2), Vector(3, 1, 2)}) {
    grain.gyration_m2 = gyration;
    const Quaternion lying = lying_pose(grain);
    Eigen::Index least = 0;
    Eigen::Index greatest = 0;
    gyration.minCoeff(&least);
    gyration.maxCoeff(&greatest);
    EXPECT_NEAR((lying * Vector::Unit(least)).y(), 1, 1e-12);
    EXPECT_NEAR((lying * Vector::Unit(greatest)).z(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace repose::dem
