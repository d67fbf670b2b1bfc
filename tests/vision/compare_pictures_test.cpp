#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"
#include "vision/compare/heap_comparison.h"

/// Drawn heaps, measured and compared as a user would.
namespace repose::vision {
namespace {

/// An edge error of e pixels costs an overlap of about 2 e / height. These heaps are 100 px high,
/// and different pictures of the same heap may use different edge detection: 1.5 px.
constexpr double kPixelIou = 0.97;
constexpr double kPixelRmse = 1.5;

testing::HeapScene scene(double left_rad = 0.45) {
  testing::HeapScene scene;
  scene.width = 800;
  scene.height = 534;
  scene.form.left_rad = left_rad;
  return scene;
}

cv::Mat heap(double left_rad = 0.45) {
  const testing::DrawnHeap drawing = testing::draw_heap(scene(left_rad));
  return mat_of(drawing.picture).clone();
}

cv::Mat warped(const cv::Mat& picture, const cv::Mat& transform) {
  cv::Mat result;
  cv::warpAffine(picture, result, transform, picture.size(), cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  return result;
}

HeapComparison compare_in_pixels(const cv::Mat& first, const cv::Mat& second,
                                 double second_scale = 1) {
  CompareOptions options;
  options.scale = {PictureScale{.length_m = 1}, PictureScale{.length_m = second_scale}};
  return compare_heaps(measured_in(first), measured_in(second), options);
}

double degrees(double rad) { return rad / kDegree; }

TEST(ComparePictures, TheSamePictureIsTheSameHeap) {
  const HeapComparison c = compare_in_pixels(heap(), heap());
  EXPECT_EQ(c.iou, 1);
  EXPECT_EQ(c.profile_rmse, 0);
  EXPECT_EQ(c.angle->difference_rad, 0);
}

TEST(ComparePictures, AShiftedPictureIsTheSameHeap) {
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 25, 0, 1, -12);
  const HeapComparison c = compare_in_pixels(heap(), warped(heap(), shift));
  EXPECT_GT(*c.iou, kPixelIou);
  EXPECT_LT(*c.profile_rmse, kPixelRmse);
  EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
}

TEST(ComparePictures, ARolledCameraSeesTheSameHeap) {
  for (const double roll_deg : {-3.0, 2.0}) {
    const cv::Mat turn = cv::getRotationMatrix2D({400, 267}, roll_deg, 1);
    const HeapComparison c = compare_in_pixels(heap(), warped(heap(), turn));
    EXPECT_GT(*c.iou, kPixelIou) << roll_deg;
    EXPECT_LT(std::abs(degrees(c.angle->difference_rad)), 0.3) << roll_deg;
    EXPECT_EQ(c.angle->verdict, Agreement::equivalent) << roll_deg;
  }
}

TEST(ComparePictures, AnotherResolutionShowsTheSameHeap) {
  cv::Mat small;
  cv::resize(heap(), small, {}, 0.5, 0.5, cv::INTER_AREA);
  for (const HeapComparison& c : {compare_in_pixels(heap(), small, 2),
                                  compare_heaps(measured_in(heap()), measured_in(small))}) {
    EXPECT_GT(*c.iou, kPixelIou);
    EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
  }
}

TEST(ComparePictures, AMirroredPictureHasTheSidesSwapped) {
  cv::Mat mirrored;
  cv::flip(heap(0.6), mirrored, 1);
  const HeapComparison c = compare_in_pixels(heap(0.6), mirrored);
  EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
  EXPECT_NEAR(degrees(c.left.angle->difference_rad), -degrees(c.right.angle->difference_rad), 0.3);
  EXPECT_GT(std::abs(degrees(c.left.angle->difference_rad)), 3) << "the heap leans";
  EXPECT_NEAR(*c.left.profile_mean, -*c.right.profile_mean, 1.0);
}

TEST(ComparePictures, APhotographAndItsSilhouetteAgree) {
  testing::HeapScene render_scene = scene();
  render_scene.style = testing::Style::silhouette;
  const ReposeAngle photo = measured_in(heap());
  const ReposeAngle render = measure_repose_angle(testing::draw_heap(render_scene).picture);
  const HeapComparison c = compare_heaps(photo, render);
  EXPECT_GT(*c.iou, kPixelIou);
  EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
}

TEST(ComparePictures, TheIntervalHoldsTheTrueDifference) {
  int held = 0;
  constexpr int kPairs = 8;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    const testing::DrawnHeap a = drawn("clean", seed, 800), b = drawn("silhouette", seed, 800);
    const HeapComparison c =
        compare_heaps(measure_repose_angle(a.picture), measure_repose_angle(b.picture));
    const double truth = *a.mean_rad() - *b.mean_rad();
    held += c.angle->interval_rad[0] <= truth && truth <= c.angle->interval_rad[1] ? 1 : 0;
  }
  EXPECT_GE(held, kPairs - 2);  // 95 % of 8, less random variation
}

TEST(ComparePictures, AFlankOutOfTheFrameLeavesTheRest) {
  const cv::Mat whole = heap();
  const cv::Mat cut = whole(cv::Rect(200, 0, 600, whole.rows)).clone();
  const HeapComparison c = compare_in_pixels(whole, cut);
  EXPECT_NE(c.left.cover, Coverage::whole);
  EXPECT_EQ(c.right.cover, Coverage::whole);
  EXPECT_GT(*c.right.iou, kPixelIou);
  EXPECT_FALSE(c.base[1]);
  EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
}

}  // namespace
}  // namespace repose::vision
