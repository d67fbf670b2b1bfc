#include "vision/measure/hints.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "tests/support/texts_of.h"
#include "tests/vision/pictures.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

/// Two drawn heaps side by side.
struct TwoHeaps {
  testing::DrawnHeap left = drawn("clean", 2, 640);
  testing::DrawnHeap right = drawn("dark", 1, 640);
  Picture picture;

  TwoHeaps() {
    cv::Mat3b both(std::max(left.picture.height, right.picture.height), 1280, cv::Vec3b());
    mat_of(left.picture).copyTo(both(cv::Rect(0, 0, 640, left.picture.height)));
    mat_of(right.picture).copyTo(both(cv::Rect(640, 0, 640, right.picture.height)));
    picture = picture_of(both);
  }
};

TEST(Hints, ABoxIsTheWholePicture) {
  const TwoHeaps pair;
  MeasureOptions options;
  options.hints.heap = Box{.x = 640, .y = 0, .width = 640, .height = pair.right.picture.height};
  const ReposeAngle inside = measure_repose_angle(pair.picture, options);
  ASSERT_TRUE(inside.angle_rad);
  EXPECT_NEAR(*inside.angle_rad, *pair.right.mean_rad(), 0.5 * kDegree);
  // In the whole picture's pixels.
  EXPECT_GT(inside.ground->from.x, 640);
  EXPECT_GT(inside.crest->x, 640);
  for (const Point& point : inside.outline) EXPECT_GE(point.x, 640);
  EXPECT_THAT(inside.warnings, Contains(Field(&Warning::code, "hints")));
}

TEST(Hints, ATiltedGroundLineIsTheAnglesBase) {
  const auto heap = drawn("clean", 2, 640);
  const Segment& ground = heap.ground;
  MeasureOptions options;
  const double rise = 0.05 * (ground.to.x - ground.from.x);
  options.hints.ground = Segment{ground.from, {ground.to.x, ground.to.y - rise}};
  const ReposeAngle result = measure_repose_angle(heap.picture, options);
  ASSERT_TRUE(result.left.angle_rad && result.right.angle_rad);
  const double tilt = std::atan(0.05);
  EXPECT_NEAR(*result.ground_tilt_rad, -tilt, 1.1 * kDegree);  // plus the picture's own
  EXPECT_NEAR(*result.left.angle_rad, *heap.left_rad - tilt, 0.8 * kDegree);
  EXPECT_NEAR(*result.right.angle_rad, *heap.right_rad + tilt, 0.8 * kDegree);
  // Two pixels at either end of the line.
  EXPECT_GT(*result.left.uncertainty_rad, 1.96 * std::sqrt(2) * 2 / 640);
}

TEST(Hints, TheCrestThatABoxCutsOffIsFlagged) {
  const auto heap = drawn("clean", 2, 800);
  const int top = static_cast<int>(heap.ground.from.y - 0.8 * heap.height_px);
  MeasureOptions options;
  options.hints.heap = Box{.x = 0, .y = top, .width = 800, .height = heap.picture.height - top};
  const ReposeAngle result = measure_repose_angle(heap.picture, options);
  EXPECT_EQ(result.status, MeasureStatus::flagged);
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, "crest_cut")));
  EXPECT_NEAR(*result.angle_rad, *heap.mean_rad(), 1 * kDegree);
}

TEST(Hints, WhatFillsLittleOfTheBoxIsNotMeant) {
  const auto heap = drawn("clean", 2, 640);
  cv::Mat3b painted = mat_of(heap.picture).clone();
  // A small black roof hangs in the box: it has the sharpest edge.
  const auto roof_foot = static_cast<int>(heap.ground.from.y - 0.75 * heap.height_px);
  const int roof_left = static_cast<int>(heap.ground.from.x) + 5;
  const std::vector<cv::Point> roof = {
      {roof_left, roof_foot}, {roof_left + 60, roof_foot}, {roof_left + 30, roof_foot - 30}};
  cv::fillConvexPoly(painted, roof, cv::Scalar::all(0));
  MeasureOptions options;
  const int top = static_cast<int>(heap.ground.from.y - 1.1 * heap.height_px);
  options.hints.heap = Box{.x = roof_left - 5,
                           .y = top,
                           .width = static_cast<int>(heap.ground.to.x) - roof_left,
                           .height = static_cast<int>(heap.ground.from.y) + 10 - top};
  const ReposeAngle result = measure_repose_angle(picture_of(painted), options);
  ASSERT_TRUE(result.angle_rad) << result.reason;
  EXPECT_NEAR(*result.angle_rad, *heap.mean_rad(), 1 * kDegree);
}

TEST(Hints, AMaskSaysItAll) {
  const auto heap = drawn("clean", 2, 640);
  std::vector<cv::Point> corners = {
      {static_cast<int>(heap.ground.to.x), static_cast<int>(heap.ground.to.y)},
      {static_cast<int>(heap.ground.from.x), static_cast<int>(heap.ground.from.y)}};
  for (const Point& p : heap.outline) {
    corners.emplace_back(static_cast<int>(p.x), static_cast<int>(p.y));
  }
  cv::Mat3b painted(heap.picture.height, heap.picture.width, cv::Vec3b());
  cv::fillPoly(painted, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar::all(255));
  // The heap in the picture itself is barely visible.
  cv::Mat faint;
  mat_of(heap.picture).convertTo(faint, CV_8UC3, 0.1, 110);
  MeasureOptions options;
  options.hints.mask = picture_of(painted);
  options.hints.ground = heap.ground;
  const ReposeAngle result = measure_repose_angle(picture_of(faint), options);
  ASSERT_TRUE(result.angle_rad) << result.reason;
  EXPECT_NEAR(*result.angle_rad, *heap.mean_rad(), 0.5 * kDegree);
}

/// Grey, which means unknown, with a patch of one lightness.
Picture patched_mask(const Picture& picture, const cv::Rect& patch, int lightness) {
  cv::Mat3b mask(picture.height, picture.width, cv::Vec3b::all(128));
  mask(patch).setTo(cv::Scalar::all(lightness));
  return picture_of(mask);
}

TEST(Hints, AMaskMaySayOnlyWhatIsNoHeap) {
  const auto heap = drawn("clean", 2, 640);
  const ReposeAngle without = measure_repose_angle(heap.picture);
  MeasureOptions options;
  options.hints.mask = patched_mask(heap.picture, {10, 10, 120, 40}, 0);
  const ReposeAngle with = measure_repose_angle(heap.picture, options);
  ASSERT_TRUE(without.angle_rad && with.angle_rad) << with.reason;
  EXPECT_EQ(with.status, without.status);
  EXPECT_NEAR(*with.angle_rad, *without.angle_rad, 0.5 * kDegree);
}

TEST(Hints, AMaskMaySayOnlyWhatIsHeap) {
  const TwoHeaps pair;
  for (const auto* heap : {&pair.left, &pair.right}) {
    const int shift = heap == &pair.left ? 0 : 640;
    const int middle = static_cast<int>((heap->ground.from.x + heap->ground.to.x) / 2) + shift;
    const int low = static_cast<int>(heap->ground.from.y - heap->height_px / 3);
    MeasureOptions options;
    options.hints.mask = patched_mask(pair.picture, {middle - 10, low - 10, 20, 20}, 255);
    const ReposeAngle result = measure_repose_angle(pair.picture, options);
    ASSERT_TRUE(result.crest) << result.reason;
    EXPECT_EQ(result.crest->x > 640, heap == &pair.right);
  }
}

TEST(Hints, WhatIsNoHeapDoesNotMakeTheRestOne) {
  // A brick that no hint marks as a heap.
  cv::Mat3b brick(480, 640, cv::Vec3b::all(200));
  cv::fillPoly(
      brick, std::vector<std::vector<cv::Point>>{{{120, 400}, {240, 200}, {400, 200}, {520, 400}}},
      cv::Scalar(40, 60, 160));
  MeasureOptions options;
  options.hints.mask = patched_mask(picture_of(brick), {10, 10, 120, 40}, 0);
  const auto unlike = Contains(Field(&Warning::code, "unlike_a_heap"));
  EXPECT_THAT(measure_repose_angle(picture_of(brick), options).warnings, unlike);
  options.hints.mask = patched_mask(picture_of(brick), {300, 300, 40, 40}, 255);
  EXPECT_THAT(measure_repose_angle(picture_of(brick), options).warnings, Not(unlike));
}

TEST(Hints, APlaceOnTheHeapChoosesBetweenTwo) {
  const TwoHeaps pair;
  for (const auto* heap : {&pair.left, &pair.right}) {
    const double shift = heap == &pair.left ? 0 : 640;
    const double middle = (heap->ground.from.x + heap->ground.to.x) / 2 + shift;
    MeasureOptions options;
    options.hints.keep = {{middle, heap->ground.from.y - heap->height_px / 3}};
    const ReposeAngle result = measure_repose_angle(pair.picture, options);
    ASSERT_TRUE(result.crest) << result.reason;
    EXPECT_EQ(result.crest->x > 640, heap == &pair.right);
  }
}

TEST(Hints, ThatCannotBeMeantAreRefusedAllAtOnce) {
  Hints hints;
  hints.heap = Box{.x = 500, .y = 0, .width = 200, .height = 100};
  hints.ground = Segment{{10, 10}, {12, 90}};
  hints.keep = {{-1, 5}};
  hints.drop = {{std::numeric_limits<double>::quiet_NaN(), 5}};
  hints.mask = blank_picture(10, 10);
  EXPECT_THAT(texts_of(problems_of(hints, 640, 480)),
              ElementsAre(HasSubstr("heap box = 500,0,200,100"), HasSubstr("ground points"),
                          HasSubstr("point to keep"), HasSubstr("point to drop"),
                          HasSubstr("the mask is 10 x 10")));
  MeasureOptions options;
  options.hints = hints;
  const auto heap = drawn("clean", 2, 640);
  EXPECT_THROW(measure_repose_angle(heap.picture, options), base::InputError);
  EXPECT_THAT(problems_of({}, 640, 480), SizeIs(0));
}

TEST(Hints, NameThemselves) {
  Hints hints;
  EXPECT_TRUE(hints.empty());
  EXPECT_EQ(hints.text(), "");
  hints.heap = Box{.x = 0, .y = 0, .width = 10, .height = 10};
  hints.keep = {{1, 1}};
  hints.drop = {{2, 2}, {3, 3}};
  EXPECT_EQ(hints.text(), "box around the heap, 1 point on the heap, 2 points off the heap");
}

}  // namespace
}  // namespace repose::vision
