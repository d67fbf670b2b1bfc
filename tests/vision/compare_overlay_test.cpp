#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "tests/vision/measured_triangles.h"
#include "tests/vision/plain_picture.h"
#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

Picture plain_backdrop(std::uint8_t brightness) { return plain_picture(1000, 700, brightness); }

Picture draw(const TriangleHeap& first, const TriangleHeap& second, std::uint8_t brightness = 90,
             const CompareOptions& options = {}) {
  const ReposeAngle a = measured(first), b = measured(second);
  return draw_comparison(plain_backdrop(brightness), a, compare_heaps(a, b, options),
                         {.titles = {"photo.jpg", "render.png"}, .margin_rad = 0.03});
}

CompareOptions in_pixels() {
  CompareOptions options;
  options.scale = {PictureScale{.length_m = 1e-3}, PictureScale{.length_m = 1e-3}};
  return options;
}

/// Darkest grey in every column of a part of the chart.
std::vector<int> darkest(const Picture& overlay, cv::Rect part) {
  cv::Mat grey;
  cv::cvtColor(mat_of(overlay)(part), grey, cv::COLOR_BGR2GRAY);
  cv::Mat columns;
  cv::reduce(grey, columns, 0, cv::REDUCE_MIN);
  return {columns.begin<std::uint8_t>(), columns.end<std::uint8_t>()};
}

TEST(ComparisonOverlay, LinesAreToldApartWithoutColour) {
  // The second heap is twice as high, so above half the chart's height only its line is there.
  for (const std::uint8_t brightness : {0, 128, 255}) {
    const Picture overlay = draw({.height = 75}, {}, brightness, in_pixels());
    // Chart: bases 600 px + 8 % each side = 1400 px; the tip is at 700, 350 px above the ground.
    const std::vector<int> upper = darkest(overlay, {480, 110, 160, 130});
    const auto dark = std::count_if(upper.begin(), upper.end(), [](int g) { return g < 150; });
    EXPECT_GT(dark, 40) << "dashes";
    EXPECT_LT(dark, 120) << "gaps";
    const std::vector<int> lower = darkest(overlay, {300, 290, 80, 120});
    EXPECT_TRUE(std::all_of(lower.begin(), lower.end(), [](int g) { return g < 60; }))
        << "the first heap's line has no gaps";
  }
}

TEST(ComparisonOverlay, ThePictureIsFaded) {
  const Picture overlay = draw({}, {}, 0);
  const auto between = mat_of(overlay).at<cv::Vec3b>(300, 600);
  EXPECT_GT(between[0], 150) << "black has become light";
}

TEST(ComparisonOverlay, ReachesBeyondThePicture) {
  const Picture overlay = draw({}, {.left_base = 2000, .right_base = 2000}, 0, in_pixels());
  EXPECT_EQ(mat_of(overlay).at<cv::Vec3b>(20, 20), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(overlay.width, 1400);
}

TEST(ComparisonOverlay, OddHeapsAreNoTrouble) {
  CompareOptions unlike = in_pixels();
  unlike.scale[1]->length_m = 1e-7;
  EXPECT_EQ(draw({}, {}, 90, unlike).width, 1400);
  unlike.scale[1]->length_m = 1e3;
  EXPECT_EQ(draw({}, {}, 90, unlike).width, 1400);
  EXPECT_EQ(draw({.has_right = false}, {.has_left = false}).width, 1400);
  EXPECT_EQ(draw({.cut_left = 200}, {}).width, 1400);
  EXPECT_LE(draw({.left_base = 1, .right_base = 1, .step = 0.1}, {}, 90, in_pixels()).height, 3000);
}

TEST(ComparisonOverlay, SameComparisonSameBytes) {
  EXPECT_EQ(draw({}, {.height = 120}).bgr, draw({}, {.height = 120}).bgr);
}

TEST(ComparisonOverlay, NothingToDrawIsRefused) {
  const ReposeAngle heap = measured({});
  const HeapComparison refused = compare_heaps(heap, {});
  EXPECT_THROW(draw_comparison(plain_backdrop(90), heap, refused, {}), base::InputError);
  EXPECT_THROW(draw_comparison({}, heap, compare_heaps(heap, heap), {}), base::InputError);
}

}  // namespace
}  // namespace repose::vision
