#include "vision/camera/board.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "tests/support/drawn_board.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Largest distance of a corner from its true place in the picture.
double worst_error_px(const std::vector<SeenCorner>& corners, const testing::BoardCamera& camera,
                      const testing::BoardPlace& place) {
  double worst = 0;
  for (const SeenCorner& corner : corners) {
    const Point at = board_corner(corner.number);
    const Point truth = camera.seen(
        place.origin_mm + place.square_mm * (place.rotation * Eigen::Vector3d(at.x, at.y, 0)));
    worst = std::max(worst, std::hypot(corner.place.x - truth.x, corner.place.y - truth.y));
  }
  return worst;
}

TEST(Board, AllCornersAreFoundWhereTheyAre) {
  const testing::BoardCamera camera{.k1 = -.1};
  const auto place = testing::placed_board({15, -10, 700}, .3, -.2, .1);
  const auto corners = find_board(board_photo(camera, place));
  ASSERT_EQ(corners.size(), static_cast<std::size_t>(kBoardCorners));
  EXPECT_LT(worst_error_px(corners, camera, place), .4);  // due to noise and blur
}

TEST(Board, HalfABoardUpsideDownIsKnownByItsMarkers) {
  const testing::BoardCamera camera;
  const auto place = testing::placed_board({230, 0, 700}, 0, 0, 3.1);
  const auto corners = find_board(board_photo(camera, place));
  ASSERT_GE(corners.size(), 20U);
  ASSERT_LT(corners.size(), static_cast<std::size_t>(kBoardCorners));
  EXPECT_LT(worst_error_px(corners, camera, place), .4);
}

TEST(Board, APictureWithoutOneShowsNone) {
  EXPECT_THAT(find_board(blank_picture(640, 480)), IsEmpty());
  // A mirror image is a different board.
  const testing::BoardCamera camera;
  Picture mirrored = board_photo(camera, testing::placed_board({0, 0, 700}, 0, 0, 0));
  cv::Mat image = mat_of(mirrored);
  cv::flip(image.clone(), image, 1);
  EXPECT_THAT(find_board(mirrored), IsEmpty());
}

TEST(Board, ThePrintedPageShowsAllOfItAtTrueSize) {
  for (const Paper paper : {Paper::a4, Paper::letter}) {
    constexpr double kDpi = 127;  // five pixels per millimetre
    const Picture page = board_picture(paper, kDpi);
    EXPECT_EQ(page.width, paper == Paper::a4 ? 1485 : 1397);
    const auto corners = find_board(page);
    ASSERT_EQ(corners.size(), static_cast<std::size_t>(kBoardCorners));
    const Point first = corners.front().place, last = corners.back().place;
    EXPECT_NEAR(last.x - first.x, 5 * kBoardSquare_mm * (kBoardColumns - 2), .3);
    EXPECT_NEAR(last.y - first.y, 5 * kBoardSquare_mm * (kBoardRows - 2), .3);
  }
}

TEST(Board, ThePdfIsTheSameWheneverItIsMade) {
  const std::string pdf = board_pdf(Paper::a4);
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 841.889"));  // 297 mm
  EXPECT_EQ(pdf, board_pdf(Paper::a4));
  EXPECT_NE(pdf, board_pdf(Paper::letter));
}

}  // namespace
}  // namespace repose::vision
