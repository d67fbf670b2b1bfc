#include "vision/drawing/slopes_overlay.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "base/input_error.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

Picture white(int width, int height) {
  Picture picture = blank_picture(width, height);
  std::fill(picture.bgr.begin(), picture.bgr.end(), std::uint8_t{255});
  return picture;
}

Slope steep() {
  return {
      .name = "upper left", .angle_rad = .7, .line = {{.x = 200, .y = 300}, {.x = 500, .y = 550}}};
}

TEST(SlopesOverlay, DrawsEachLineAndARowForItBelowThePicture) {
  const Picture picture = white(900, 900);
  const Picture none = draw_slopes_overlay(picture, {}, "front");
  const Picture one = draw_slopes_overlay(picture, {steep()}, "front");
  EXPECT_GT(none.height, picture.height);
  EXPECT_GT(one.height, none.height);
  const auto middle = mat_of(one).at<cv::Vec3b>(425, 350);
  EXPECT_GT(middle[2], middle[0] + 100) << "red on white";
  const auto beside = mat_of(one).at<cv::Vec3b>(425, 250);
  EXPECT_EQ(beside, cv::Vec3b(255, 255, 255));
}

TEST(SlopesOverlay, SaysWhereThereIsNoSlope) {
  const Picture picture = white(900, 900);
  const Slope missing{.name = "upper right", .angle_rad = {}, .line = {}};
  const Picture drawn = draw_slopes_overlay(picture, {missing}, "front");
  EXPECT_GT(drawn.height, draw_slopes_overlay(picture, {}, "front").height);
  EXPECT_EQ(mat_of(drawn).at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 255)) << "no line";
}

TEST(SlopesOverlay, NoPictureIsRefused) {
  EXPECT_THROW(draw_slopes_overlay({}, {steep()}, "front"), base::InputError);
}

}  // namespace
}  // namespace repose::vision
