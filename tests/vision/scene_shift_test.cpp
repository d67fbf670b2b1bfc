#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "vision/film/scene_change.h"

namespace repose::vision {
namespace {

constexpr int kSceneWidth = 240, kSceneHeight = 160;

/// A scene with the brightness as a function of position.
template <typename Light>
cv::Mat scene_of(const Light& light) {
  cv::Mat scene(kSceneHeight, kSceneWidth, CV_8UC3);
  for (int y = 0; y < kSceneHeight; ++y) {
    for (int x = 0; x < kSceneWidth; ++x) scene.at<cv::Vec3b>(y, x) = light(x, y);
  }
  return scene;
}

cv::Vec3b grey_pixel(double level) { return cv::Vec3b::all(cv::saturate_cast<uchar>(level)); }

/// Soft waves of a few tens of pixels, shifted.
cv::Mat waves(double across_px, double down_px) {
  return scene_of([&](int x, int y) {
    return grey_pixel(150 + 20 * std::sin((x - across_px) / 9) + 20 * std::cos((y - down_px) / 11));
  });
}

/// A wall that darkens towards its corners, with light falling on one side.
cv::Mat wall(double light) {
  return scene_of([&](int x, int y) {
    const double off = std::hypot(x - .5 * kSceneWidth, y - .5 * kSceneHeight) / kSceneWidth;
    const double side = std::exp(-.5 * std::pow((x - 60.) / 30, 2));
    return grey_pixel(200 - 12 * off * off + light * side);
  });
}

TEST(SceneShift, IsThatOfASceneThatMoved) {
  const SceneShift scene(waves(0, 0));
  for (const cv::Point2d& moved : {cv::Point2d(3, -2), cv::Point2d(-5, 1), cv::Point2d(.5, 0)}) {
    const cv::Mat now = waves(moved.x, moved.y);
    EXPECT_LT(cv::norm(scene.of(now) - moved), .2) << moved;
  }
  EXPECT_LT(cv::norm(scene.of(waves(0, 0))), .05);
}

TEST(SceneShift, IsNoneOfALightThatChangesOnAPlainWall) {
  EXPECT_EQ(SceneShift(wall(0)).of(wall(8)), cv::Point2d(0, 0));
}

TEST(SceneShift, IsNoneWhereThereIsNothingToHoldOnTo) {
  const cv::Mat blank = scene_of([](int, int) { return grey_pixel(120); });
  EXPECT_EQ(SceneShift(blank).of(blank), cv::Point2d(0, 0));
  EXPECT_EQ(SceneShift(blank).of(waves(2, 2)), cv::Point2d(0, 0));
}

}  // namespace
}  // namespace repose::vision
