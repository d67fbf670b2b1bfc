#include "vision/measure/working_picture.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

const cv::Scalar kBlack{0, 0, 0};
const cv::Scalar kGrey{150, 150, 150};

cv::Mat3b grey_picture(int width, int height) {
  return cv::Mat3b(height, width, cv::Vec3b(150, 150, 150));
}

/// Black bars of `bar` rows above and below a grey picture.
cv::Mat3b letterboxed(int bar) {
  cv::Mat3b picture = grey_picture(400, 300);
  picture.rowRange(0, bar).setTo(kBlack);
  picture.rowRange(300 - bar, 300).setTo(kBlack);
  return picture;
}

TEST(WorkingPicture, SmallPicturesKeepTheirSize) {
  const WorkingPicture work = work_of(grey_picture(400, 300));
  EXPECT_EQ(work.shrink, 1);
  EXPECT_EQ(work.bgr.size(), cv::Size(400, 300));
  EXPECT_EQ(work.lab.size(), cv::Size(400, 300));
  EXPECT_EQ(work.frame, cv::Rect(0, 0, 400, 300));
  EXPECT_EQ(cv::countNonZero(work.valid_mask), 400 * 300);
}

TEST(WorkingPicture, LargeOnesAreShrunkToTheWorkingSide) {
  const WorkingPicture wide = work_of(grey_picture(2000, 1000));
  EXPECT_EQ(wide.shrink, 2.5);
  EXPECT_EQ(wide.bgr.size(), cv::Size(kWorkingSide, 400));
  EXPECT_EQ(work_of(grey_picture(300, 1200)).bgr.size(), cv::Size(200, kWorkingSide));
}

TEST(WorkingPicture, ShrinkingAveragesThePixels) {
  cv::Mat3b checks(1600, 1600);
  for (int row = 0; row < checks.rows; ++row) {
    for (int col = 0; col < checks.cols; ++col) {
      checks(row, col) = (row + col) % 2 == 0 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(200, 200, 200);
    }
  }
  EXPECT_EQ(work_of(checks).bgr(300, 300), cv::Vec3b(100, 100, 100));
}

/// The left part in another colour, and single pixels in a third one.
cv::Mat3b of_colours(const cv::Vec3b& left, const cv::Vec3b& right, int singles,
                     const cv::Vec3b& third) {
  cv::Mat3b picture(750, 1000, right);
  picture.colRange(0, 333).setTo(left);
  for (int k = 0; k < singles; ++k) picture(749 - k, 999 - k) = third;
  return picture;
}

TEST(WorkingPicture, TonesAreThoseOfAPictureWithoutAThirdColour) {
  const cv::Vec3b one(10, 20, 30);
  const cv::Vec3b other(10, 20, 31);
  const cv::Vec3b third(11, 20, 31);
  EXPECT_EQ(work_of(of_colours(one, other, 0, third)).tones, (Tones{one, other}));
  EXPECT_FALSE(work_of(of_colours(one, other, 1, third)).tones.has_value());
  EXPECT_FALSE(work_of(of_colours(one, one, 0, third)).tones.has_value());
  EXPECT_TRUE(work_of(of_colours(one, one, 1, third)).tones.has_value());
}

TEST(WorkingPicture, GreysOfTwoTonesAreThoseOfAnyPicture) {
  const cv::Vec3b dark(20, 20, 20);
  const cv::Vec3b light(230, 230, 230);
  const WorkingPicture two = work_of(of_colours(dark, light, 0, {}));
  const WorkingPicture any = work_of(of_colours(dark, light, 1, {231, 230, 230}));
  ASSERT_TRUE(two.tones && !any.tones);
  const cv::Rect without_third(0, 0, 700, 500);
  EXPECT_EQ(cv::norm(two.bgr(without_third), any.bgr(without_third), cv::NORM_INF), 0);
  EXPECT_LT(cv::norm(two.lab(without_third), any.lab(without_third), cv::NORM_INF), 1e-3);
}

TEST(WorkingPicture, LightnessRunsFromBlackToWhite) {
  cv::Mat3b picture = grey_picture(100, 100);
  picture.rowRange(0, 50).setTo(cv::Scalar(255, 255, 255));
  picture.rowRange(90, 100).setTo(kBlack);
  const WorkingPicture work = work_of(picture);
  EXPECT_NEAR(work.lab(10, 50)[0], 100, 0.1);
  EXPECT_NEAR(work.lab(95, 50)[0], 0, 0.1);
  EXPECT_NEAR(work.lab(10, 50)[1], 0, 0.1);
}

TEST(WorkingPicture, ExcludedBoxesAreNoEvidence) {
  const WorkingPicture work =
      working_picture(picture_of(grey_picture(400, 300)), {{10, 20, 30, 40}, {390, 290, 10, 10}});
  EXPECT_EQ(cv::countNonZero(work.valid_mask), 400 * 300 - 30 * 40 - 10 * 10);
  EXPECT_EQ(cv::countNonZero(work.valid_mask(cv::Rect(10, 20, 30, 40))), 0);
}

TEST(WorkingPicture, ExcludedBoxesOfAShrunkPictureAreRoundedOutwards) {
  const WorkingPicture work =
      working_picture(picture_of(grey_picture(1600, 800)), {{101, 101, 50, 50}});
  // 101 to 151 in half-sized pixels: 50.5 to 75.5.
  EXPECT_EQ(cv::countNonZero(work.valid_mask(cv::Rect(50, 50, 26, 26))), 0);
  EXPECT_EQ(cv::countNonZero(work.valid_mask), 800 * 400 - 26 * 26);
}

TEST(WorkingPicture, APairOfBarsIsNoPartOfThePicture) {
  const WorkingPicture work = work_of(letterboxed(30));
  // One row at each bar's edge is removed with it: in a scaled picture it is blurred.
  EXPECT_EQ(work.frame, cv::Rect(0, 31, 400, 238));
  EXPECT_EQ(cv::countNonZero(work.valid_mask), work.frame.area());
}

TEST(WorkingPicture, BarsAtTheSidesAreRemovedLikewise) {
  const WorkingPicture work = work_of(letterboxed(30).t());
  EXPECT_EQ(work.frame, cv::Rect(31, 0, 238, 400));
}

TEST(WorkingPicture, ATimerLaidOverABarLeavesItABar) {
  cv::Mat3b picture = letterboxed(40);
  cv::putText(picture, "00:12.34", {20, 28}, cv::FONT_HERSHEY_SIMPLEX, 0.7, {255, 255, 255}, 2);
  EXPECT_EQ(work_of(picture).frame, cv::Rect(0, 41, 400, 218));
}

TEST(WorkingPicture, ASingleDarkStripIsNoLetterbox) {
  cv::Mat3b picture = grey_picture(400, 300);
  picture.rowRange(260, 300).setTo(kBlack);  // a dark table
  EXPECT_EQ(work_of(picture).frame, cv::Rect(0, 0, 400, 300));
}

TEST(WorkingPicture, ADarkBackdropIsNoLetterbox) {
  cv::Mat3b picture(300, 400, cv::Vec3b(8, 8, 8));
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{{{80, 220}, {200, 140}, {320, 220}}},
               kGrey);
  EXPECT_EQ(work_of(picture).frame, cv::Rect(0, 0, 400, 300));
}

TEST(WorkingPicture, ABlackPictureKeepsItsFrame) {
  EXPECT_EQ(work_of(cv::Mat3b(200, 300, cv::Vec3b(0, 0, 0))).frame, cv::Rect(0, 0, 300, 200));
}

}  // namespace
}  // namespace repose::vision
