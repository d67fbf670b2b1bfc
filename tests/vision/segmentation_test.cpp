#include "vision/measure/segmentation.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

/// Normal numbers around `low` above row 60 and around `high` below it.
cv::Mat1f two_populations(double low, double high, double deviation) {
  testing::Random random(1);
  cv::Mat1f values(100, 200);
  for (int row = 0; row < values.rows; ++row) {
    for (float& value : cv::Mat1f(values.row(row))) {
      value = static_cast<float>(random.normal(row < 60 ? low : high, deviation));
    }
  }
  return values;
}

cv::Mat1b everywhere(const cv::Mat& like) { return cv::Mat1b(like.size(), 255); }

/// 255 in a triangle that stands on a ground at 4/5 of the height, 0 elsewhere.
cv::Mat1b heap_mask(cv::Size size) {
  cv::Mat1b mask = cv::Mat1b::zeros(size);
  const int ground = size.height * 4 / 5;
  cv::fillPoly(mask,
               std::vector<std::vector<cv::Point>>{{{size.width / 5, ground},
                                                    {size.width / 2, size.height / 3},
                                                    {size.width * 4 / 5, ground}}},
               255);
  return mask;
}

TEST(OtsuThreshold, LiesBetweenTwoPopulations) {
  const cv::Mat1f values = two_populations(30, 70, 4);
  const double threshold = otsu_threshold(values, everywhere(values));
  EXPECT_GT(threshold, 30 + 3 * 4);
  EXPECT_LT(threshold, 70 - 3 * 4);
}

TEST(OtsuThreshold, FollowsTheUnitOfTheValues) {
  const cv::Mat1f values = two_populations(30, 70, 4);
  const double threshold = otsu_threshold(values, everywhere(values));
  // The histogram has 256 steps.
  EXPECT_NEAR(otsu_threshold(values * 1000 - 5000, everywhere(values)), threshold * 1000 - 5000,
              64 * 1000. / 255);
}

TEST(OtsuThreshold, ExcludedPixelsDoNotMoveIt) {
  const cv::Mat1f values = two_populations(30, 70, 4);
  cv::Mat1b valid_mask = everywhere(values);
  valid_mask(cv::Rect(20, 10, 60, 50)) = 0;
  const double threshold = otsu_threshold(values, valid_mask);
  for (const float painted : {-500.F, 0.F, 900.F}) {
    cv::Mat1f boxed = values.clone();
    boxed(cv::Rect(20, 10, 60, 50)) = painted;
    EXPECT_EQ(otsu_threshold(boxed, valid_mask), threshold) << painted;
    EXPECT_NE(otsu_threshold(boxed, everywhere(values)), threshold) << painted;
  }
}

TEST(OtsuThreshold, IsANumberWhereNothingCanBeToldApart) {
  const cv::Mat1f level(40, 40, 12.F);
  EXPECT_EQ(otsu_threshold(level, everywhere(level)), 12);
  EXPECT_EQ(otsu_threshold(level, cv::Mat1b::zeros(level.size())), 0);
}

TEST(GreyOtsu, FindsDarkHeapsAndLightOnes) {
  for (const auto& [heap, backdrop] : {std::pair(40, 210), {210, 40}}) {
    const cv::Mat1b mask = heap_mask({300, 200});
    cv::Mat3b picture(mask.size(), cv::Vec3b::all(static_cast<std::uint8_t>(backdrop)));
    picture.setTo(cv::Scalar::all(heap), mask);
    EXPECT_EQ(overlap(grey_otsu(work_of(picture)).inside, mask), 1) << heap;
  }
}

TEST(TwoToneSegmentation, TakesThatToneForTheHeapWhichTheBackdropIsNot) {
  for (const auto& [heap, backdrop] : {std::pair(cv::Vec3b(0, 0, 0), cv::Vec3b(255, 255, 255)),
                                       {cv::Vec3b(40, 90, 200), cv::Vec3b(40, 110, 200)}}) {
    const cv::Mat1b mask = heap_mask({300, 200});
    cv::Mat3b picture(mask.size(), backdrop);
    picture.setTo(heap, mask);
    const WorkingPicture work = work_of(picture);
    ASSERT_TRUE(work.tones.has_value());
    EXPECT_GT(overlap(two_tone_segmentation(work, *work.tones).inside, mask), 0.99);
  }
}

TEST(TwoToneSegmentation, EdgeOfAShrunkPictureLiesWhereHalfOfAPixelIsCovered) {
  // Steps of a pixel are .25 working pixels.
  for (int first = 1600; first < 1608; ++first) {
    cv::Mat3b picture(2400, 3200, cv::Vec3b(255, 255, 255));
    picture.rowRange(first, 2400).setTo(cv::Scalar(0, 0, 0));
    const WorkingPicture work = work_of(picture);
    ASSERT_EQ(work.shrink, 4);
    const cv::Mat1f inside = two_tone_segmentation(work, *work.tones).inside;
    int row = 0;
    while (inside(row, 400) <= 0) ++row;
    const double below = inside(row, 400);
    const double above = inside(row - 1, 400);
    EXPECT_NEAR(row + 0.5 - below / (below - above), first / 4.0, 0.05) << first;
  }
}

const Segmentation& segmentation_named(const std::vector<Segmentation>& all,
                                       const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
}

TEST(BlindSegmentations, BackdropModelFollowsAGradient) {
  // The left of the backdrop is as dark as the heap's right: no brightness threshold separates
  // them.
  const cv::Mat1b mask = heap_mask({600, 400});
  cv::Mat3b picture(mask.size());
  testing::Random random(1);
  for (int row = 0; row < picture.rows; ++row) {
    for (int col = 0; col < picture.cols; ++col) {
      const double light = 0.5 + 0.5 * col / picture.cols;
      const double grey = (mask(row, col) != 0 ? 150 : 240) * light + random.normal(0, 2);
      picture(row, col) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
    }
  }
  const auto all = unsupervised_segmentations(work_of(picture));
  EXPECT_LT(overlap(segmentation_named(all, "otsu lightness").inside, mask), 0.8);
  EXPECT_GT(overlap(segmentation_named(all, "backdrop model").inside, mask), 0.97);
}

TEST(BlindSegmentations, ColourTellsHeapsAsBrightAsTheirBackdrop) {
  const cv::Mat1b mask = heap_mask({600, 400});
  cv::Mat3b picture(mask.size(), cv::Vec3b(150, 130, 130));
  picture.setTo(cv::Scalar(70, 135, 165), mask);
  const auto all = unsupervised_segmentations(work_of(picture));
  EXPECT_GT(overlap(segmentation_named(all, "otsu yellow-blue").inside, mask), 0.97);
}

TEST(BlindSegmentations, CoverThePictureUnderDifferentNames) {
  const auto all = unsupervised_segmentations(work_of(cv::Mat3b(120, 160, cv::Vec3b(90, 90, 90))));
  std::set<std::string> names;
  for (const Segmentation& segmentation : all) {
    EXPECT_EQ(segmentation.inside.size(), cv::Size(160, 120));
    EXPECT_TRUE(cv::checkRange(segmentation.inside)) << segmentation.name << " holds NaN";
    EXPECT_TRUE(names.insert(segmentation.name).second) << segmentation.name << " twice";
  }
  EXPECT_GE(names.size(), 4);
}

TEST(RoughSegmentation, FindsGrainsBeforeTheirOwnColour) {
  const cv::Mat1b mask = heap_mask({600, 400});
  cv::Mat3b picture(mask.size(), cv::Vec3b(128, 128, 128));
  testing::Random random(1);
  for (int row = 0; row < picture.rows; ++row) {
    for (int col = 0; col < picture.cols; ++col) {
      if (mask(row, col) == 0) continue;
      const double grey = random.normal(128, 30);
      picture(row, col) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
    }
  }
  EXPECT_GT(overlap(rough_segmentation(work_of(picture)).inside, mask), 0.9);
}

TEST(Roughness, IsTheLocalDeviation) {
  const cv::Mat1f noise = two_populations(50, 50, 5);
  // The window covers 35 pixels; the local mean takes a few per cent off.
  EXPECT_NEAR(cv::mean(roughness(noise, everywhere(noise), 3))[0], 5, 0.5);
  const cv::Mat1f level(50, 50, 7.F);
  EXPECT_NEAR(cv::mean(roughness(level, everywhere(level), 3))[0], 0, 1e-3);
}

/// Largest difference inside the valid mask.
double largest_difference(const cv::Mat1f& one, const cv::Mat1f& other,
                          const cv::Mat1b& valid_mask) {
  return cv::norm(one, other, cv::NORM_INF, valid_mask);
}

TEST(Smoothed, KeepsALevelPictureLevelUpToAnExcludedBox) {
  cv::Mat1f values(60, 80, 7.F);
  cv::Mat1b valid_mask = everywhere(values);
  valid_mask(cv::Rect(20, 10, 30, 30)) = 0;
  values(cv::Rect(20, 10, 30, 30)) = 500;
  EXPECT_LT(largest_difference(smoothed(values, valid_mask, 3), cv::Mat1f(60, 80, 7.F), valid_mask),
            1e-3);
  EXPECT_LT(
      largest_difference(roughness(values, valid_mask, 3), cv::Mat1f(60, 80, 0.F), valid_mask),
      1e-1);
  EXPECT_TRUE(cv::checkRange(smoothed(values, cv::Mat1b::zeros(values.size()), 3)));
}

TEST(BlindSegmentations, ExcludedPixelsDoNotShineInFromABox) {
  const cv::Mat1b mask = heap_mask({600, 400});
  cv::Mat3b picture(mask.size(), cv::Vec3b(190, 180, 170));
  picture.setTo(cv::Scalar(60, 90, 120), mask);
  const Box box{180, 60, 100, 120};  // up to the left flank
  std::vector<std::vector<Segmentation>> found;
  cv::Mat1b valid_mask;
  for (const int paint : {0, 255}) {
    picture(cv::Rect(box.x, box.y, box.width, box.height)) =
        cv::Vec3b::all(static_cast<std::uint8_t>(paint));
    const WorkingPicture work = working_picture(picture_of(picture), {box});
    valid_mask = work.valid_mask;
    found.push_back(unsupervised_segmentations(work));
  }
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    // L*a*b* from 0 to 100; the box differs by 100.
    EXPECT_LT(largest_difference(found[0][i].inside, found[1][i].inside, valid_mask), 0.01)
        << found[0][i].name;
  }
}

}  // namespace
}  // namespace repose::vision
