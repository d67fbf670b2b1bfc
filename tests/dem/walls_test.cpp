#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dem/wall/facets.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {
namespace {

void expect_closest(const Closest& spot, double distance, const Vector& normal) {
  EXPECT_NEAR(spot.distance, distance, 1e-14);
  EXPECT_NEAR((spot.normal - normal).norm(), 0, 1e-14);
}

TEST(ClosestOnPlane, IsStraightBelow) {
  expect_closest(closest(Plane{}, {3, -4, 2}), 2, Vector::UnitZ());
  expect_closest(closest(Plane{}, {3, -4, -2}), -2, Vector::UnitZ());
}

const Box kBox{.half_size = {1, 2, 3}};

TEST(ClosestOnBox, FacesEdgesAndCorners) {
  expect_closest(closest(kBox, {0, 0, 5}), 2, Vector::UnitZ());
  expect_closest(closest(kBox, {-1.5, 1, 1}), .5, -Vector::UnitX());
  expect_closest(closest(kBox, {4, 6, 0}), 5, Vector(.6, .8, 0));
  expect_closest(closest(kBox, {3, 4, 4}), 3, Vector(2, 2, 1) / 3);
}

TEST(ClosestOnBox, InsideTheNearestFaceCounts) {
  expect_closest(closest(kBox, {0, 0, 2.9}), -.1, Vector::UnitZ());
  expect_closest(closest(kBox, {-.9, 0, 0}), -.1, -Vector::UnitX());
}

const Tube kTube{.inner_radius = 2, .thickness = 1, .height = 5};

TEST(ClosestOnTube, InnerAndOuterSide) {
  expect_closest(closest(kTube, {0, 1.5, 2}), .5, -Vector::UnitY());
  expect_closest(closest(kTube, {-4, 0, 2}), 1, -Vector::UnitX());
}

TEST(ClosestOnTube, OnTheAxisItIsTheInnerRadiusAway) {
  expect_closest(closest(kTube, {0, 0, 2}), 2, -Vector::UnitX());
}

TEST(ClosestOnTube, RimsAndTheirEdges) {
  expect_closest(closest(kTube, {2.5, 0, 6}), 1, Vector::UnitZ());
  expect_closest(closest(kTube, {0, 2.5, -1}), 1, -Vector::UnitZ());
  expect_closest(closest(kTube, {1.7, 0, 5.4}), .5, Vector(-.6, 0, .8));
  expect_closest(closest(kTube, {3.3, 0, -.4}), .5, Vector(.6, 0, -.8));
}

TEST(ClosestOnTube, InsideTheMaterialTheNearestSideCounts) {
  expect_closest(closest(kTube, {2.9, 0, 2}), -.1, Vector::UnitX());
  expect_closest(closest(kTube, {2.5, 0, 4.9}), -.1, Vector::UnitZ());
}

Wall moving_plane() {
  Wall wall;
  wall.shape = Plane{};
  return wall;
}

TEST(WallAt, StandsStillBeforeAndAfterAMotion) {
  Wall wall = moving_plane();
  wall.motions = {{.velocity = {0, 0, 2}, .start_s = 1, .stop_s = 3}};
  EXPECT_EQ(wall_at(wall, .5).pose.position.z(), 0);
  EXPECT_EQ(wall_at(wall, .5).velocity.norm(), 0);
  EXPECT_EQ(wall_at(wall, 2).pose.position.z(), 2);
  EXPECT_EQ(wall_at(wall, 2).velocity.z(), 2);
  EXPECT_EQ(wall_at(wall, 9).pose.position.z(), 4);
  EXPECT_EQ(wall_at(wall, 9).velocity.norm(), 0);
}

TEST(WallAt, MotionsFollowOneAnother) {
  Wall wall = moving_plane();
  wall.motions = {{.velocity = {1, 0, 0}, .start_s = 0, .stop_s = 1},
                  {.velocity = {0, 1, 0}, .start_s = 2, .stop_s = 4}};
  EXPECT_EQ(wall_at(wall, 10).pose.position, Vector(1, 2, 0));
}

TEST(WallAt, TurnsAboutItsPivot) {
  Wall wall = moving_plane();
  wall.motions = {{.spin = {0, 0, std::numbers::pi / 2}, .pivot = {1, 0, 0}, .stop_s = 1}};
  const WallMoment end = wall_at(wall, 1);
  EXPECT_NEAR((end.pose.position - Vector(1, -1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((end.pose.orientation * Vector::UnitX() - Vector::UnitY()).norm(), 0, 1e-15);
}

/// Position, at a given time, of a point fixed to the wall.
Vector carried(const Wall& wall, const Vector& own, double time) {
  const Pose pose = wall_at(wall, time).pose;
  return pose.position + pose.orientation * own;
}

TEST(WallAt, PointsMoveAtTheVelocityThatItTells) {
  Wall wall = moving_plane();
  wall.pose.position = {.2, .3, .4};
  wall.pose.orientation = Eigen::AngleAxisd(.7, Vector(1, 2, 3).normalized());
  wall.motions = {{.velocity = {.1, -.2, .3}, .spin = {1, -2, .5}, .pivot = {1, 1, 0}}};
  const Vector own(.5, -.6, .7);
  constexpr double kTime = .8;
  constexpr double kStep = 1e-6;
  const Vector rate =
      (carried(wall, own, kTime + kStep) - carried(wall, own, kTime - kStep)) / (2 * kStep);
  const WallMoment now = wall_at(wall, kTime);
  EXPECT_NEAR((now.velocity_at(carried(wall, own, kTime)) - rate).norm(), 0, 1e-8);
}

TEST(WallSet, ContactIsInWorldAxes) {
  Wall wall = moving_plane();
  wall.pose.position = {0, 0, 1};
  wall.pose.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitY());
  WallSet walls({wall});
  const FacetContact contact = walls.contact(0, 0, {3, 5, 7});
  EXPECT_NEAR(contact.distance, 3, 1e-14);
  EXPECT_NEAR((contact.normal - Vector::UnitX()).norm(), 0, 1e-14);
}

TEST(WallSet, FacetsAreNearWithinTheDistanceOnly) {
  WallSet walls({moving_plane()});
  std::vector<int> facets = {7};
  walls.facets_near(0, {0, 0, 1}, .9, facets);
  EXPECT_TRUE(facets.empty());
  walls.facets_near(0, {0, 0, 1}, 1.1, facets);
  EXPECT_EQ(facets, std::vector<int>{0});
}

TEST(WallSet, NewMotionStartsWhereTheWallIs) {
  Wall wall = moving_plane();
  wall.motions = {{.velocity = {0, 0, 1}}};
  WallSet walls({wall});
  walls.move_to(2);
  walls.set_motions(0, {{.velocity = {0, 0, -1}}}, 2);
  walls.move_to(3);
  EXPECT_NEAR(walls.moment(0).pose.position.z(), 1, 1e-15);
}

TEST(WallSet, GreatestSpeedCountsSpinAndForgetsWhatIsOver) {
  Wall wall = moving_plane();
  wall.motions = {{.velocity = {3, 0, 0}, .spin = {0, 0, 2}, .stop_s = 1}};
  WallSet walls({wall});
  const Eigen::AlignedBox3d grains(Vector(-.5, -.5, -7), Vector(.5, .5, 7));
  EXPECT_NEAR(walls.greatest_speed(0, grains), 3 + 2 * std::hypot(.5, .5), 1e-12)
      << "far along the axis is not far from it";
  EXPECT_EQ(walls.greatest_speed(0, {}), 0) << "of no grains";
  EXPECT_EQ(walls.greatest_speed(1, grains), 0);
  walls.remove(0);
  EXPECT_EQ(walls.greatest_speed(0, grains), 0);
}

TEST(WallSet, ASphereTouchesWhereItsCentresContactIsNearerThanItsRadius) {
  const Pose turned{.position = {.1, 0, 0}, .orientation = Quaternion(.8, .6, 0, 0)};
  const Pose moved{.position = {.1, -.2, .3}};
  const WallSet walls({{.shape = kTube, .pose = moved},
                       {.shape = kBox, .pose = moved},
                       {.shape = Plane{}, .pose = moved},
                       {.shape = kTube, .pose = turned},
                       {.shape = kBox, .pose = turned}});
  constexpr double kRadius = .4;
  for (int wall = 0; wall < walls.size(); ++wall) {
    int touching = 0;
    for (int k = 0; k < 20000; ++k) {
      const Vector centre(8 * std::sin(1.3 * k), 8 * std::sin(2.9 * k), 8 * std::sin(.7 * k));
      const FacetContact contact = walls.contact(wall, 0, centre);
      FacetContact where;
      ASSERT_EQ(walls.touches(wall, 0, centre, kRadius, where), contact.distance < kRadius)
          << wall << ": " << centre;
      if (!(contact.distance < kRadius)) continue;
      ++touching;
      EXPECT_EQ(where.distance, contact.distance) << wall << ": " << centre;
      EXPECT_EQ(where.normal, contact.normal) << wall << ": " << centre;
      EXPECT_EQ(where.curvature, contact.curvature) << wall << ": " << centre;
    }
    EXPECT_GT(touching, 50) << wall;
  }
}

}  // namespace
}  // namespace repose::dem
