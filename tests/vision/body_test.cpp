#include "vision/measure/body.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"
#include "vision/measure/camera_pitch.h"

namespace repose::vision {
namespace {

using Corners = std::vector<cv::Point2d>;

constexpr int kCols = 600;
constexpr int kRows = 400;

const cv::Scalar kBackdrop{220, 220, 220};
const cv::Scalar kHeap{60, 90, 120};
const cv::Scalar kPlate{110, 105, 100};

/// A picture of polygons and its perfect threshold: dark is inside.
struct PaintedScene {
  cv::Mat3b picture = cv::Mat3b(kRows, kCols, cv::Vec3b(220, 220, 220));

  PaintedScene& paint(const Corners& corners, const cv::Scalar& colour) {
    std::vector<cv::Point> fine;  // sixteenths of a pixel; OpenCV's pixel centres are whole
    for (const cv::Point2d& p : corners) {
      fine.emplace_back(cvRound((p.x - 0.5) * 16), cvRound((p.y - 0.5) * 16));
    }
    cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{fine}, colour, cv::LINE_AA, 4);
    return *this;
  }
  WorkingPicture work() const { return work_of(picture); }
  Segmentation segmentation() const {
    cv::Mat1b grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    cv::Mat1f inside;
    grey.convertTo(inside, CV_32F, -1, 165);
    return {"dark", inside};
  }
  std::vector<Body> bodies() const { return find_bodies(segmentation(), work()); }
};

const Corners kTriangleCorners = {{120, 300}, {300, 190}, {480, 300}};

Corners rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

Corners turned(Corners corners, double angle_rad) {
  for (cv::Point2d& p : corners) {
    const cv::Point2d d = p - cv::Point2d(300, 300);
    p = cv::Point2d(300, 300) + cv::Point2d(d.x * std::cos(angle_rad) - d.y * std::sin(angle_rad),
                                            d.x * std::sin(angle_rad) + d.y * std::cos(angle_rad));
  }
  return corners;
}

TEST(FindBodies, AHeapStandsOnItsBase) {
  const auto bodies = PaintedScene().paint(kTriangleCorners, kHeap).bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.y(300), 300, 1);
  EXPECT_NEAR(bodies[0].ground.tilt_rad(), 0, 0.05 * kDegree);
  EXPECT_NEAR(cv::countNonZero(bodies[0].mask), 360 * 110 / 2., 780);  // a pixel all around
  EXPECT_NEAR(bodies[0].ground.bow.value(), 0, 0.005);
  EXPECT_FALSE(bodies[0].ground.mirrored);
}

TEST(FindBodies, ATiltedBaseIsATiltedGround) {
  for (const double tilt_deg : {-4.0, 3.0}) {
    const auto bodies =
        PaintedScene().paint(turned(kTriangleCorners, tilt_deg * kDegree), kHeap).bodies();
    ASSERT_EQ(bodies.size(), 1);
    EXPECT_NEAR(bodies[0].ground.tilt_rad(), tilt_deg * kDegree, 0.1 * kDegree);
  }
}

TEST(FindBodies, HolesAreFilled) {
  const PaintedScene whole = PaintedScene().paint(kTriangleCorners, kHeap);
  PaintedScene holed = whole;
  holed.paint(rectangle(290, 240, 30, 20), kBackdrop);
  EXPECT_EQ(cv::countNonZero(holed.bodies().at(0).mask != whole.bodies().at(0).mask), 0);
}

TEST(FindBodies, HolesAreFilledInABodyAtTheFrameAndNothingElse) {
  // A half heap against the frame's left side: the backdrop is contiguous only above it.
  const Corners half = {{-5, 300}, {-5, 120}, {300, 300}};
  PaintedScene scene;
  scene.paint(half, kHeap).paint(rectangle(5, 220, 20, 20), kBackdrop);
  const auto bodies = scene.bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_EQ(bodies[0].mask(230, 10), 255) << "the hole";
  EXPECT_EQ(bodies[0].mask(350, 10), 0) << "below the heap";
  EXPECT_EQ(bodies[0].mask(50, 10), 0) << "above it";
}

TEST(FindBodies, ThePlateIsCutOff) {
  // The segmentation includes the plate in the heap; it is bare left and right of the heap.
  const Corners strip = rectangle(-5, 300, kCols + 10, 30);
  const auto bodies = PaintedScene().paint(strip, kPlate).paint(kTriangleCorners, kHeap).bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.y(300), 300, 1);
  EXPECT_EQ(cv::countNonZero(bodies[0].mask.rowRange(302, kRows)), 0);
  EXPECT_EQ(bodies[0].mask(310 - 20, 300), 255);
  EXPECT_NEAR(cv::countNonZero(bodies[0].mask), 360 * 110 / 2., 780);
}

TEST(FindBodies, ATiltedPlateIsCutOffAlongItsEdge) {
  const double tilt = 2 * kDegree;
  const auto bodies = PaintedScene()
                          .paint(turned(rectangle(-50, 300, kCols + 100, 30), tilt), kPlate)
                          .paint(turned(kTriangleCorners, tilt), kHeap)
                          .bodies();
  ASSERT_FALSE(bodies.empty());
  EXPECT_NEAR(bodies[0].ground.tilt_rad(), tilt, 0.1 * kDegree);
}

TEST(FindBodies, AnApronOfTheHeapsMaterialIsNotTheGround) {
  // The same shape as heap and plate, but all of grains, on a plate that can be told from them.
  const Corners apron = rectangle(-5, 290, kCols + 10, 14);
  const auto bodies = PaintedScene()
                          .paint(rectangle(-5, 304, kCols + 10, 40), {200, 200, 200})
                          .paint(apron, kHeap)
                          .paint({{120, 292}, {300, 182}, {480, 292}}, kHeap)
                          .bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.y(300), 304, 1.5) << "under the apron, not on it";
}

TEST(FindBodies, AReflectionsAxisIsTheGround) {
  const Corners image = {{120, 300}, {300, 410}, {480, 300}};
  const auto bodies =
      PaintedScene().paint(image, {120, 135, 150}).paint(kTriangleCorners, kHeap).bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_TRUE(bodies[0].ground.mirrored);
  EXPECT_FALSE(bodies[0].ground.bow) << "the base is not seen";
  EXPECT_NEAR(bodies[0].ground.y(300), 300, 1);
  EXPECT_NEAR(bodies[0].ground.tilt_rad(), 0, 0.1 * kDegree);
  EXPECT_EQ(cv::countNonZero(bodies[0].mask.rowRange(302, kRows)), 0);
}

TEST(FindBodies, AnEdgeThatTheHeapCrossesIsBehindIt) {
  const Corners table = rectangle(-5, 300, kCols + 10, 110);
  const Corners lower = {{90, 320}, {300, 190}, {510, 320}};
  const auto bodies = PaintedScene().paint(table, kPlate).paint(lower, kHeap).bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.y(300), 300, 1);
  EXPECT_TRUE(bodies[0].ground.behind);

  const auto standing = PaintedScene().paint(table, kPlate).paint(kTriangleCorners, kHeap).bodies();
  ASSERT_EQ(standing.size(), 1);
  EXPECT_FALSE(standing[0].ground.behind);
}

TEST(FindBodies, WhatRunsOutOfTheFrameDoesNotTiltTheGround) {
  // Haze joins the left foot to the frame's lower edge, 20 pixels below the base.
  PaintedScene scene =
      PaintedScene().paint(kTriangleCorners, kHeap).paint(rectangle(-5, 290, 140, 30), kHeap);
  scene.picture = scene.picture.rowRange(0, 320).clone();
  const auto bodies = scene.bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.tilt_rad(), 0, 0.05 * kDegree);
  EXPECT_NEAR(bodies[0].ground.y(300), 300, 1);
}

TEST(FindBodies, AnExcludedBoxDoesNotTiltTheGround) {
  const PaintedScene scene = PaintedScene().paint(turned(kTriangleCorners, 1 * kDegree), kHeap);
  const WorkingPicture work = working_picture(picture_of(scene.picture), {{130, 285, 150, 40}});
  const auto bodies = find_bodies(scene.segmentation(), work);
  ASSERT_EQ(bodies.size(), 1);
  // Half of the base remains: a pixel more or less at its end is 0.3 degrees.
  EXPECT_NEAR(bodies[0].ground.tilt_rad(), 1 * kDegree, 0.2 * kDegree);
}

TEST(FindBodies, AHeapCutByTheFramesLowerEdgeHasAGroundOfUnknownTilt) {
  PaintedScene scene = PaintedScene().paint(turned(kTriangleCorners, 2 * kDegree), kHeap);
  scene.picture = scene.picture.rowRange(0, 280).clone();
  const auto bodies = scene.bodies();
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_NEAR(bodies[0].ground.y(300), 280, 1);
  EXPECT_GE(bodies[0].ground.deviation_rad, 1 * kDegree);
  EXPECT_FALSE(bodies[0].ground.bow) << "the base is not seen";
}

/// The silhouette of a cone seen from above: the hull of its apex and its base's ellipse.
Corners cone_corners(double pitch_rad) {
  constexpr double kRadius = 200;
  const double height = kRadius * std::tan(30 * kDegree);
  std::vector<cv::Point2f> points = {{300, static_cast<float>(280 - height * std::cos(pitch_rad))}};
  for (int i = 0; i < 720; ++i) {
    const double around = i * kDegree / 2;
    points.emplace_back(static_cast<float>(300 + kRadius * std::cos(around)),
                        static_cast<float>(280 + kRadius * std::sin(pitch_rad) * std::sin(around)));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  return {hull.begin(), hull.end()};
}

TEST(FindBodies, ABowedBaseTellsTheCamerasPitch) {
  for (const double pitch_deg : {6.0, 12.0, 20.0}) {
    const auto bodies = PaintedScene().paint(cone_corners(pitch_deg * kDegree), kHeap).bodies();
    ASSERT_EQ(bodies.size(), 1);
    // The rim's far half is visible up to the flanks' feet: an arc slightly longer than a half.
    EXPECT_NEAR(pitch_from_bow(bodies[0].ground.bow.value()) / kDegree, pitch_deg, 0.1 * pitch_deg);
  }
}

TEST(FindBodies, LargestComesFirst) {
  const auto bodies = PaintedScene()
                          .paint({{20, 300}, {60, 270}, {100, 300}}, kHeap)
                          .paint({{200, 300}, {380, 190}, {560, 300}}, kHeap)
                          .bodies();
  ASSERT_EQ(bodies.size(), 2);
  EXPECT_EQ(bodies[0].mask(290, 380), 255);
  EXPECT_EQ(bodies[1].mask(290, 60), 255);
}

TEST(FindBodies, NothingInsideHasNoBody) { EXPECT_TRUE(PaintedScene().bodies().empty()); }

TEST(LargestRegion, IsTakenAsItIs) {
  const Corners strip = rectangle(-5, 300, kCols + 10, 30);
  const PaintedScene scene = PaintedScene().paint(strip, kPlate).paint(kTriangleCorners, kHeap);
  const Body body = largest_region(scene.segmentation(), scene.work());
  EXPECT_EQ(body.mask(315, 10), 255) << "the plate belongs to it";
  EXPECT_EQ(body.ground.slope, 0);
  EXPECT_NEAR(body.ground.y(0), 330, 1);
}

TEST(LargestRegion, IsEmptyWhereThereIsNone) {
  const PaintedScene nothing;
  EXPECT_TRUE(largest_region(nothing.segmentation(), nothing.work()).mask.empty());
}

TEST(BodyOn, KeepsTheGroundThatIsKnown) {
  const PaintedScene scene = PaintedScene().paint(kTriangleCorners, kHeap);
  Body known = scene.bodies().at(0);
  static_cast<PictureLine&>(known.ground) = {280, 0};
  const Body again = body_on(known, scene.segmentation(), scene.work());
  EXPECT_EQ(again.ground.y(300), 280);
  EXPECT_GT(cv::countNonZero(again.mask), 0);
  EXPECT_EQ(cv::countNonZero(again.mask.rowRange(281, kRows)), 0);
  EXPECT_TRUE(body_on(known, PaintedScene().segmentation(), scene.work()).mask.empty());
}

TEST(CountStrays, CountsSmallThingsOnTheGround) {
  PaintedScene scene = PaintedScene().paint(kTriangleCorners, kHeap);
  const Body body = scene.bodies().at(0);
  EXPECT_EQ(count_strays(body, scene.segmentation(), scene.work()), 0);
  scene.paint(rectangle(40, 290, 10, 10), kHeap)
      .paint(rectangle(70, 288, 12, 12), kHeap)
      .paint(rectangle(540, 291, 9, 9), kHeap)
      .paint(rectangle(540, 100, 10, 10), kHeap)  // in the air
      .paint(rectangle(40, 340, 10, 10), kHeap)   // below the ground
      .paint(rectangle(560, 298, 2, 2), kHeap);   // dust
  EXPECT_EQ(count_strays(body, scene.segmentation(), scene.work()), 3);
}

}  // namespace
}  // namespace repose::vision
