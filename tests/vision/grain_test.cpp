#include "vision/measure/grain.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {
namespace {

TEST(GrainSize, IsWithinAThirdOnGeneratedPictures) {
  for (const char* condition : {"clean", "inverted_white", "uneven_light", "apron"}) {
    std::vector<double> ratios;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto heap = drawn(condition, seed, kWorkingSide);
      const auto grain = grain_size(work_of(mat_of(heap.picture)), mask_of(heap));
      ASSERT_TRUE(grain) << condition << seed;
      ratios.push_back(*grain / heap.grain_px);
      EXPECT_GT(ratios.back(), 0.5) << condition << ' ' << seed;
      EXPECT_LT(ratios.back(), 1.5) << condition << ' ' << seed;
    }
    // "Good to about a third": typically; in rare cases the error may be half.
    EXPECT_NEAR(median(ratios), 1, 1. / 3) << condition;
  }
}

TEST(GrainSize, DoesNotDependOnTheLight) {
  const auto heap = drawn("clean", 3, kWorkingSide);
  const cv::Mat1b mask = mask_of(heap);
  cv::Mat3b picture = mat_of(heap.picture).clone();
  const auto before = grain_size(work_of(picture), mask);
  for (int col = 0; col < picture.cols; ++col) picture.col(col) *= 0.5 + 0.5 * col / picture.cols;
  const auto after = grain_size(work_of(picture), mask);
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(*after, *before, 1.3);  // its resolution is a lag of one pixel
}

TEST(GrainSize, ASilhouetteShowsNone) {
  const auto heap = drawn("silhouette", 1, kWorkingSide);
  EXPECT_FALSE(grain_size(work_of(mat_of(heap.picture)), mask_of(heap)));
}

TEST(GrainSize, SpecksInASilhouetteAreNoGrain) {
  const auto heap = drawn("silhouette", 1, kWorkingSide);
  const cv::Mat1b mask = mask_of(heap);
  cv::Mat3b picture = mat_of(heap.picture).clone();
  const cv::Rect box = cv::boundingRect(mask);
  const cv::Vec3b backdrop = picture(0, 0);
  for (int speck = 1; speck <= 5; ++speck) {  // gaps between grains that one can look through
    const cv::Point at(box.x + speck * box.width / 6, box.br().y - box.height / 6);
    cv::circle(picture, at, 4, cv::Scalar(backdrop), cv::FILLED);
  }
  EXPECT_FALSE(grain_size(work_of(picture), mask));
}

TEST(GrainSize, NoiseOfSinglePixelsIsNoGrain) {
  testing::Random random(1);
  cv::Mat3b picture(300, 400);
  for (cv::Vec3b& pixel : picture) {
    pixel = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(random.normal(120, 12)));
  }
  cv::Mat1b body = cv::Mat1b::zeros(picture.size());
  body(cv::Rect(50, 100, 300, 150)) = 255;
  const auto grain = grain_size(work_of(picture), body);
  EXPECT_LT(grain.value_or(0), 2.5);
}

TEST(GrainSize, AThinOrMissingBodyShowsNone) {
  const WorkingPicture work = work_of(cv::Mat3b(100, 100, cv::Vec3b(90, 90, 90)));
  cv::Mat1b body = cv::Mat1b::zeros(100, 100);
  EXPECT_FALSE(grain_size(work, body));
  body(cv::Rect(10, 50, 80, 6)) = 255;
  EXPECT_FALSE(grain_size(work, body));
}

}  // namespace
}  // namespace repose::vision
