#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"
#include "tests/dem/shapes.h"

namespace repose::testing {
namespace {

using dem::MassProperties;
using dem::Mesh;
using dem::PrincipalFrame;
using dem::Quaternion;
using dem::Vector;

constexpr double kRounding = 1e-12;  // for sums of some thousand terms in double precision

const Quaternion kTurn = Quaternion(0.3, -0.5, 0.7, 0.2).normalized();
const Vector kShift(0.31, -1.7, 0.4);

TEST(MassProperties, OfABoxAreThoseOfTheTextbook) {
  const MassProperties box =
      dem::mass_properties(moved(box_surface(2, 3, 5), Quaternion::Identity(), kShift));
  EXPECT_NEAR(box.volume_m3, 30, 30 * kRounding);
  EXPECT_TRUE(box.centroid.isApprox(kShift, kRounding));
  const Vector expected = Vector(4, 9, 25) / 12;
  EXPECT_TRUE(box.second_moment_m2.isApprox(Eigen::Matrix3d(expected.asDiagonal()), kRounding))
      << box.second_moment_m2;
}

TEST(MassProperties, OfATetrahedronIncludeItsProductsOfInertia) {
  // Moments of the standard simplex: V 1/6, mean of x 1/4, of x^2 1/10, of x y 1/20.
  const MassProperties body = dem::mass_properties(corner_tetrahedron(1, 2, 3));
  EXPECT_NEAR(body.volume_m3, 1, kRounding);
  EXPECT_TRUE(body.centroid.isApprox(Vector(0.25, 0.5, 0.75), kRounding));
  EXPECT_NEAR(body.second_moment_m2(0, 0), 0.1 - 0.0625, kRounding);
  EXPECT_NEAR(body.second_moment_m2(0, 1), 2 * (0.05 - 0.0625), kRounding);
  EXPECT_NEAR(body.second_moment_m2(1, 2), 6 * (0.05 - 0.0625), kRounding);
}

TEST(MassProperties, OfAnEllipsoidComeCloseToTheSmoothOne) {
  const Mesh mesh = dem::calliper_surface({.length_m = 0.04, .width_m = 0.03, .thickness_m = 0.02});
  const MassProperties body = dem::mass_properties(mesh);
  // The polyhedron lies inside the ellipsoid: by .2 % of the volume for this number of triangles.
  constexpr double kFacets = 3e-3;
  const double volume = std::numbers::pi / 6 * 0.04 * 0.03 * 0.02;
  EXPECT_LT(body.volume_m3, volume);
  EXPECT_NEAR(body.volume_m3 / volume, 1, kFacets);
  EXPECT_NEAR(body.second_moment_m2(0, 0) / (0.02 * 0.02 / 5), 1, kFacets);
  EXPECT_NEAR(body.second_moment_m2(1, 1) / (0.015 * 0.015 / 5), 1, kFacets);
  EXPECT_NEAR(body.second_moment_m2(2, 2) / (0.01 * 0.01 / 5), 1, kFacets);
}

TEST(MassProperties, OfAFarAwayGrainKeepTheirDigits) {
  const Mesh nut = nut_surface();
  const Mesh far = moved(nut, Quaternion::Identity(), Vector(100, -200, 50));
  // Coordinates at 200 m resolve 3e-14 m, compared with a grain of 2e-2 m.
  EXPECT_NEAR(dem::mass_properties(far).volume_m3 / dem::mass_properties(nut).volume_m3, 1, 1e-9);
}

TEST(MassProperties, RefusesASurfaceThatIsInsideOutFlatOrEmpty) {
  EXPECT_THROW(dem::mass_properties(inside_out(box_surface(1, 1, 1))), base::InputError);
  EXPECT_THROW(dem::mass_properties(box_surface(1, 1, 0)), base::InputError);
  EXPECT_THROW(dem::mass_properties({}), base::InputError);
}

TEST(PrincipalFrame, OrdersItsAxesFromTheLongOneToTheShortOne) {
  const PrincipalFrame frame = dem::principal_frame(box_surface(0.02, 0.05, 0.03));
  EXPECT_LT(frame.gyration_m2.x(), frame.gyration_m2.y());
  EXPECT_LT(frame.gyration_m2.y(), frame.gyration_m2.z());
  EXPECT_TRUE(frame.axes.col(0).isApprox(Vector::UnitY(), 1e-9)) << frame.axes;
  EXPECT_TRUE(frame.axes.col(1).isApprox(Vector::UnitZ(), 1e-9)) << frame.axes;
  EXPECT_NEAR(frame.axes.determinant(), 1, kRounding);
}

TEST(PrincipalFrame, SeesTheSameBodyHoweverTheScanLies) {
  // A tetrahedron has no symmetry, so the order and signs of its axes are unique.
  const Mesh body = corner_tetrahedron(0.011, 0.022, 0.035);
  const Mesh straight = dem::in_frame(body, dem::principal_frame(body));
  const Mesh scan = moved(body, kTurn, kShift);
  const Mesh turned = dem::in_frame(scan, dem::principal_frame(scan));
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    EXPECT_LT((straight.vertices[i] - turned.vertices[i]).norm(), 1e-12) << "corner " << i;
  }
}

TEST(PrincipalFrame, HasItsOriginInTheCentreOfMassAndNoProductsOfInertia) {
  const Mesh scan = moved(nut_surface(), kTurn, kShift);
  const PrincipalFrame frame = dem::principal_frame(scan);
  const MassProperties body = dem::mass_properties(dem::in_frame(scan, frame));
  EXPECT_LT(body.centroid.norm(), 1e-12);
  const Eigen::Matrix3d gyration = dem::gyration_of(body.second_moment_m2);
  EXPECT_TRUE(gyration.isApprox(Eigen::Matrix3d(frame.gyration_m2.asDiagonal()), 1e-9)) << gyration;
}

TEST(PrincipalFrame, PointsItsLongAxisToTheTip) {
  const Quaternion half_turn(0, 0, 0, 1);
  for (const Quaternion& turn : {Quaternion::Identity(), half_turn}) {
    const PrincipalFrame frame = dem::principal_frame(moved(nut_surface(), turn, Vector::Zero()));
    EXPECT_GT(frame.axes.col(0).dot(turn * Vector::UnitX()), 0.999);
  }
}

TEST(PrincipalFrame, OfACubeIsTheScansOwn) {
  EXPECT_TRUE(
      dem::principal_frame(box_surface(1, 1, 1)).axes.isApprox(Eigen::Matrix3d::Identity()));
}

TEST(PrincipalFrame, KeepsToTheScansAxesAcrossABodyOfRevolution) {
  const Mesh rod = dem::calliper_surface({.length_m = 0.04, .width_m = 0.02, .thickness_m = 0.02});
  EXPECT_TRUE(
      dem::principal_frame(rod).axes.cwiseAbs().isApprox(Eigen::Matrix3d::Identity(), 1e-9));
}

TEST(SphereShape, HasTheVolumeAndInertiaOfASphere) {
  const dem::ClumpShape shape = dem::sphere_shape(0.01);
  EXPECT_NEAR(shape.volume_m3, 4.18879020478639e-6, 1e-18);
  EXPECT_TRUE(shape.gyration_m2.isApprox(Vector::Constant(4e-5), kRounding));
  EXPECT_DOUBLE_EQ(shape.reach_m(), 0.01);
  EXPECT_THROW(dem::sphere_shape(0), base::InputError);
  EXPECT_THROW(dem::sphere_shape(std::nan("")), base::InputError);
}

TEST(ClumpShape, ReachesAsFarAsItsFarthestSphere) {
  dem::ClumpShape shape;
  EXPECT_EQ(shape.reach_m(), 0);
  shape.spheres = {{Vector(0, 0, 3), 1}, {Vector(0, -4, 0), 0.5}};
  EXPECT_DOUBLE_EQ(shape.reach_m(), 4.5);
}

}  // namespace
}  // namespace repose::testing
