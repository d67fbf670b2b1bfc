#include <cmath>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "vision/measure/likeness.h"

namespace repose::vision {
namespace {

constexpr int kHigh = 120;
constexpr int kWide = 300;

/// A body that fills a picture, except for a margin, with the grey levels of `shade`.
template <class Shade>
BodyTexture texture_in(Shade shade) {
  cv::Mat3b picture(kHigh + 20, kWide + 20, cv::Vec3b(230, 230, 230));
  cv::Mat1b body = cv::Mat1b::zeros(picture.size());
  for (int row = 10; row < kHigh + 10; ++row) {
    for (int col = 10; col < kWide + 10; ++col) {
      const auto grey = cv::saturate_cast<std::uint8_t>(shade(row, col));
      picture(row, col) = {grey, grey, grey};
      body(row, col) = 255;
    }
  }
  return texture_of(body, kHigh, work_of(picture));
}

TEST(BodyTexture, OneColourIsEven) {
  const BodyTexture plain = texture_in([](int, int) { return 60; });
  EXPECT_EQ(plain.noise, 0);
  EXPECT_EQ(plain.even, 1);
  EXPECT_EQ(plain.straight, 0);
  EXPECT_EQ(plain.patchy, 0);
}

TEST(BodyTexture, GrainsByChancePointAnywhereAndRepeatNowhere) {
  testing::Random random(3);
  cv::Mat1f grains(kHigh + 20, kWide + 20);
  for (float& value : grains) value = static_cast<float>(random.normal(0, 1));
  cv::GaussianBlur(grains, grains, {}, 2);
  const BodyTexture texture =
      texture_in([&](int row, int col) { return 120 + 300 * grains(row, col); });
  EXPECT_GT(texture.noise, 2);
  EXPECT_LT(texture.even, 0.1);
  EXPECT_LT(texture.aligned, 0.1);
  EXPECT_LT(texture.crossed, 0.1);
  EXPECT_LT(texture.regular, 0.1);
}

TEST(BodyTexture, GapsBetweenGrainsLeaveASilhouetteEven) {
  const BodyTexture silhouette =
      texture_in([](int row, int col) { return row % 40 < 3 && (col + row) % 91 < 3 ? 255 : 0; });
  EXPECT_GT(silhouette.even, 0.99);
  EXPECT_GT(silhouette.noise, 0.1);
  EXPECT_TRUE(silhouette.is_silhouette());
}

TEST(BodyTexture, HowEdgesOfASilhouetteRunIsNotLookedAt) {
  // Gaps in rows and columns, which would be a pattern.
  const BodyTexture silhouette =
      texture_in([](int row, int col) { return row % 40 < 3 && col % 41 < 4 ? 255 : 0; });
  EXPECT_TRUE(silhouette.is_silhouette());
  EXPECT_EQ(silhouette.crossed, 0);
  EXPECT_EQ(silhouette.regular, 0);
}

TEST(BodyTexture, BoardsRunOneWay) {
  const BodyTexture boards =
      texture_in([](int row, int col) { return (row + col / 3) / 7 % 2 == 0 ? 90 : 130; });
  EXPECT_GT(boards.aligned, 0.8);
}

TEST(BodyTexture, TilesRunTwoWaysAndRepeat) {
  const BodyTexture tiles = texture_in(
      [](int row, int col) { return row % 13 < 2 || (col + row / 13 * 6) % 13 < 2 ? 90 : 130; });
  EXPECT_LT(tiles.aligned, 0.4);
  EXPECT_GT(tiles.crossed, 0.5);
  EXPECT_GT(tiles.regular, 0.5);
}

TEST(BodyTexture, AWeaveRepeatsThoughItRunsNoWay) {
  const BodyTexture weave = texture_in([](int row, int col) {
    return 120 + 20 * (std::sin(row / 2.0) + std::sin(0.5 * row + 0.87 * col / 2.0) +
                       std::sin(-0.5 * row + 0.87 * col / 2.0));
  });
  EXPECT_GT(weave.regular, 0.5);
}

TEST(BodyTexture, PartsOfOtherColoursArePatchy) {
  const BodyTexture parts = texture_in([](int, int col) { return col / 40 % 2 == 0 ? 60 : 160; });
  EXPECT_GT(parts.patchy, 0.1);
}

TEST(BodyTexture, AStraightEdgeInsideIsAsLongAsItIsDrawn) {
  const BodyTexture crossed =
      texture_in([](int row, int col) { return row > 30 + col / 6 ? 60 : 110; });
  EXPECT_NEAR(crossed.straight, kWide * std::hypot(1, 1.0 / 6) / kHigh, 0.25);
}

TEST(BodyTexture, ABodyThatIsAllRimHasNone) {
  cv::Mat1b body = cv::Mat1b::zeros(60, 60);
  body(cv::Rect(10, 10, 8, 8)) = 255;
  const BodyTexture none = texture_of(body, 8, work_of(cv::Mat3b(60, 60, cv::Vec3b(9, 9, 9))));
  EXPECT_EQ(none.noise, 0);
  EXPECT_EQ(none.even, 0);
  EXPECT_EQ(none.aligned, 0);
}

}  // namespace
}  // namespace repose::vision
