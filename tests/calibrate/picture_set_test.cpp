// Photographs of measured heaps as a set.

#include "calibrate/experiment/picture_set.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using vision::MeasureStatus;

SetPicture picture(double angle_deg, MeasureStatus status = MeasureStatus::ok,
                   const std::string& heap = {}) {
  return {.status = status, .angle_deg = angle_deg, .own_deg = .98, .camera_deg = .5, .heap = heap};
}

TEST(PictureSet, AFlaggedWrongObjectAmongHeapsIsNamedAndNotAveraged) {
  const PictureSet set = set_of_pictures(std::vector<SetPicture>{
      picture(21.5), picture(22), picture(22.9), picture(51.2, MeasureStatus::flagged)});
  ASSERT_THAT(set.outliers, SizeIs(1));
  EXPECT_EQ(set.outliers[0].place, 3U);
  EXPECT_FALSE(set.outliers[0].is_counted);
  EXPECT_EQ(set.heaps_deg->n, 3);
  EXPECT_NEAR(set.heaps_deg->mean, (21.5 + 22 + 22.9) / 3, 1e-12);
  EXPECT_EQ(set.all_deg->n, 4);
  EXPECT_NEAR(set.all_deg->mean, 29.4, 1e-12);
  EXPECT_EQ(set.flagged, 0) << "of those that count";
  EXPECT_THAT(text_of(set.outliers[0], set, 51.2),
              AllOf(HasSubstr("51.20° is an outlier"), HasSubstr("left out of the mean")));
}

// Iglewicz and Hoaglin's score by hand: median 22.45; |x - m| .95 .45 .45 28.75; MAD .7; 1.4826 MAD
// exceeds the pictures' own .5.
TEST(PictureSet, TheScoreIsTheModifiedZScore) {
  const PictureSet set = set_of_pictures(
      std::vector<SetPicture>{picture(21.5), picture(22), picture(22.9), picture(51.2)});
  ASSERT_THAT(set.outliers, SizeIs(1));
  EXPECT_NEAR(set.outliers[0].score, 28.75 / (1.4826 * .7), 1e-9);
  EXPECT_TRUE(set.outliers[0].is_counted) << "nothing else is wrong with it";
  EXPECT_EQ(set.heaps_deg->n, 4);
}

TEST(PictureSet, WhatPicturesThemselvesAreUncertainByIsNoOutlier) {
  const std::vector<SetPicture> alike = {picture(22), picture(22), picture(22),
                                         picture(23.7, MeasureStatus::flagged)};
  EXPECT_THAT(set_of_pictures(alike).outliers, IsEmpty()) << "3.4 times .5";
  const std::vector<SetPicture> two = {picture(22), picture(51, MeasureStatus::flagged)};
  EXPECT_THAT(set_of_pictures(two).outliers, IsEmpty()) << "which of both is wrong is not known";
}

TEST(PictureSet, PicturesOfOneHeapAreOneHeap) {
  using enum MeasureStatus;
  const PictureSet set = set_of_pictures(
      std::vector<SetPicture>{picture(21, ok, "a"), picture(23, ok, "a"), picture(24),
                              picture(20, flagged, "b"), picture(22, ok, "b"), picture(25)});
  std::vector<double> angles;
  for (const HeapOfSet& heap : set.heaps) angles.push_back(heap.angle_deg);
  EXPECT_THAT(angles, ElementsAre(22, 24, 21, 25));
  EXPECT_EQ(set.heaps_deg->n, 4);
  EXPECT_EQ(set.heaps_deg->mean, 23);
  EXPECT_EQ(set.pictures, 6);
  EXPECT_NEAR(*set.within_sd_deg, std::sqrt(2), 1e-12) << "of 2 and 2, one degree of freedom each";
  EXPECT_EQ(set.flagged, 1);
  EXPECT_EQ(set.ok_deg->n, 4);
  EXPECT_EQ(set.ok_deg->mean, (22 + 24 + 22 + 25) / 4.);
}

// The set above by hand: w^2 = (2 + 2) / 2; s^2 = (1 + 1 + 4 + 4) / 3, of which w^2 (1/2 + 1 + 1/2
// + 1) / 4 comes from the pictures; Student's quantile for two degrees of freedom from a table.
TEST(PictureSet, WhatPicturesScatterByIsToldFromWhatHeapsDo) {
  using enum MeasureStatus;
  const PictureSet set = set_of_pictures(
      std::vector<SetPicture>{picture(21, ok, "a"), picture(23, ok, "a"), picture(24),
                              picture(20, ok, "b"), picture(22, ok, "b"), picture(25)});
  EXPECT_NEAR(set.between_sd_deg.value(), std::sqrt(10. / 3 - 2 * .75), 1e-12);
  constexpr double kStudent2 = 4.3027, kCamera = .5;
  EXPECT_EQ(set.heaps[0].name, "a");
  EXPECT_EQ(set.heaps[0].pictures, 2);
  EXPECT_NEAR(set.heaps[0].sd_deg.value(), std::sqrt(2), 1e-12);
  EXPECT_NEAR(set.heaps[0].within_deg.value(), kStudent2 + kCamera, 1e-4);
  EXPECT_FALSE(set.heaps[1].sd_deg);
  EXPECT_NEAR(set.heaps[1].within_deg.value(), kStudent2 * std::sqrt(2) + kCamera, 1e-4);
}

TEST(PictureSet, OneHeapFromManySidesHasAnIntervalButNoScatterOfHeaps) {
  std::vector<SetPicture> views;
  for (const double angle_deg : {20., 21., 22., 23., 24., 25.}) {
    views.push_back(picture(angle_deg, MeasureStatus::ok, "a"));
  }
  const PictureSet set = set_of_pictures(views);
  EXPECT_FALSE(set.between_sd_deg);
  ASSERT_THAT(set.heaps, SizeIs(1));
  constexpr double kStudent5 = 2.5706;  // for six pictures, variance 3.5
  EXPECT_NEAR(set.heaps[0].within_deg.value(), kStudent5 * std::sqrt(3.5 / 6) + .5, 1e-4);
}

TEST(PictureSet, HeapsThatDifferByNoMoreThanTheirPicturesHaveNoScatterOfTheirOwn) {
  using enum MeasureStatus;
  const PictureSet set = set_of_pictures(std::vector<SetPicture>{
      picture(20, ok, "a"), picture(24, ok, "a"), picture(20.1, ok, "b"), picture(24, ok, "b")});
  EXPECT_EQ(set.between_sd_deg, 0);
}

TEST(PictureSet, WhatTheCameraDoesToAllIsNotLoweredByMore) {
  const std::vector<SetPicture> one(1, picture(22));
  const std::vector<SetPicture> hundred(100, picture(22));
  EXPECT_NEAR(set_of_pictures(one).camera_deg, .5, 1e-12);
  EXPECT_NEAR(set_of_pictures(hundred).camera_deg, .5, 1e-12);
  EXPECT_NEAR(set_of_pictures(hundred).own_deg, .98, 1e-12) << "of a single heap";
  const std::vector<SetPicture> four(4, picture(22, MeasureStatus::ok, "a"));
  EXPECT_NEAR(set_of_pictures(four).own_deg, .49, 1e-12) << "of four pictures of one heap";
  EXPECT_NEAR(set_of_pictures(four).camera_deg, .5, 1e-12);
}

TEST(PictureSet, OfNothingHasNoMean) {
  SetPicture refused;
  refused.status = MeasureStatus::refused;
  const PictureSet set = set_of_pictures(std::vector<SetPicture>{refused});
  EXPECT_FALSE(set.heaps_deg);
  EXPECT_FALSE(set.ok_deg);
  EXPECT_EQ(set.refused, 1);
}

}  // namespace
}  // namespace repose::calibrate
