#include "vision/measure/traced_edge.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"
#include "vision/measure/choice.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {
namespace {

/// The heap in front of boards of many colours, one of them the heap's own, all out of focus.
Picture before_many_colours(const testing::DrawnHeap& heap) {
  const cv::Mat3b own = mat_of(heap.picture);
  const cv::Mat1b mask = mask_of(heap);
  const cv::Scalar grain = cv::mean(own, mask);
  const std::array<cv::Scalar, 5> colours = {cv::Scalar(30, 160, 240), grain,
                                             cv::Scalar(235, 230, 225), cv::Scalar(40, 40, 35),
                                             cv::Scalar(120, 60, 150)};
  cv::Mat3b painted(own.size());
  for (int i = 0; i < 20; ++i) {
    const cv::Rect board(i % 5 * own.cols / 5, i / 5 * own.rows / 4, own.cols / 5 + 1,
                         own.rows / 4 + 1);
    painted(board & cv::Rect({}, own.size())).setTo(colours[static_cast<std::size_t>(i * 3 % 5)]);
  }
  cv::GaussianBlur(painted, painted, {}, 6);
  cv::Mat3b noise(own.size());
  cv::randu(noise, cv::Scalar::all(0), cv::Scalar::all(8));
  painted += noise;
  own.copyTo(painted, mask);
  return picture_of(painted);
}

MeasureOptions told_of(const testing::DrawnHeap& heap) {
  MeasureOptions options;
  const int left = static_cast<int>(heap.ground.from.x) - 15;
  const int top = static_cast<int>(heap.ground.from.y - 1.1 * heap.height_px);
  options.hints.heap = Box{.x = left,
                           .y = top,
                           .width = static_cast<int>(heap.ground.to.x) + 15 - left,
                           .height = static_cast<int>(heap.ground.from.y) + 10 - top};
  options.hints.ground = heap.ground;
  return options;
}

TEST(TracedEdge, MeasuresAHeapBeforeManyColours) {
  for (const std::uint64_t seed : {2, 3, 5}) {
    const auto heap = drawn("clean", seed, 640);
    const ReposeAngle result = measure_repose_angle(before_many_colours(heap), told_of(heap));
    ASSERT_TRUE(result.angle_rad) << seed << ": " << result.reason;
    EXPECT_NEAR(*result.left.angle_rad, *heap.left_rad, 3 * kDegree) << seed;
    EXPECT_NEAR(*result.right.angle_rad, *heap.right_rad, 3 * kDegree) << seed;
    EXPECT_NEAR(*result.angle_rad, *heap.mean_rad(), *result.uncertainty_rad) << seed;
  }
}

TEST(TracedEdge, WhereAFinerEdgeIsSeenItIsTaken) {
  const auto heap = drawn("clean", 2, 640);
  const ReposeAngle result = measure_repose_angle(heap.picture, told_of(heap));
  ASSERT_TRUE(result.angle_rad) << result.reason;
  EXPECT_NE(result.segmentation, kTraced);
  EXPECT_NEAR(*result.angle_rad, *heap.mean_rad(), 0.3 * kDegree);
}

/// A wedge from column 20 up to column 100 and down to column 180, on row 90.
cv::Mat4f wedge(int height) {
  cv::Mat4f material(100, 200, cv::Vec4f(80, 0, 0, 0));
  const std::vector<cv::Point> corners = {{20, 90}, {100, 90 - height}, {180, 90}};
  cv::fillConvexPoly(material, corners, cv::Scalar(30, 0, 0, 0));
  return material;
}

TEST(SideContrast, IsGreatestAlongTheEdge) {
  const SideContrast contrast(wedge(80), cv::Mat1b(100, 200, 255));
  EXPECT_GT(contrast.at(50, 60, 1), 0.8);   // on the left flank
  EXPECT_LT(contrast.at(50, 60, -1), 0.7);  // across it
  EXPECT_LT(contrast.at(60, 100, 1), 0.1);  // inside
  EXPECT_LT(contrast.at(0, 100, 0), 0);     // nothing is seen above
}

TEST(HeapTemplate, HasTheFlanksOfAWedge) {
  const SideContrast contrast(wedge(80), cv::Mat1b(100, 200, 255));
  const HeapTemplate shape = best_template(contrast, std::vector<int>(200, 90));
  ASSERT_TRUE(shape.left);
  ASSERT_TRUE(shape.right);
  EXPECT_NEAR(shape.left->foot, 20, 6);
  EXPECT_NEAR(shape.right->foot, 180, 6);
  for (const double col : {40, 60, 140, 160}) {
    EXPECT_NEAR(shape.flank_height(col), 80 - std::abs(col - 100), 8) << col;
  }
}

TEST(HeapTemplate, HasNoFlanksWhereNothingIsSeen) {
  const SideContrast contrast(cv::Mat4f(100, 200, cv::Vec4f(80, 0, 0, 0)),
                              cv::Mat1b(100, 200, 255));
  const HeapTemplate shape = best_template(contrast, std::vector<int>(200, 90));
  EXPECT_FALSE(shape.left);
  EXPECT_FALSE(shape.right);
}

TEST(HeapTemplate, ABowedFlankIsFartherInAtHalfHeight) {
  const RoughFlank flank{.foot = 10, .top = 110, .bow = 0.08};
  EXPECT_NEAR(flank.column(0.5), 68, 1e-9);
  EXPECT_NEAR(flank.part(68), 0.5, 0.01);
  EXPECT_LT(flank.part(0), 0);
}

Reading triangle_reading(double slope) {
  Reading reading;
  for (int i = 0; i <= 200; ++i) {
    reading.profile.along.push_back(i);
    reading.profile.height.push_back(slope * (100 - std::abs(i - 100)));
  }
  set_crest(reading.profile);
  reading.profile.crest_height = 100;
  reading.left.status = FlankStatus::ok;
  for (int i = 20; i <= 80; ++i) {
    reading.left.along.push_back(i);
    reading.left.height.push_back(slope * (100 - i));
  }
  return reading;
}

TEST(EdgeDistance, IsAPartOfTheHeight) {
  EXPECT_NEAR(edge_distance(triangle_reading(1), triangle_reading(1)), 0, 1e-9);
  EXPECT_NEAR(edge_distance(triangle_reading(1), triangle_reading(0.8)), 0.106, 0.005);
}

}  // namespace
}  // namespace repose::vision
