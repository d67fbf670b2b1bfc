#include "vision/camera/lens_fit.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "base/units.h"
#include "tests/support/drawn_board.h"
#include "tests/support/heap_random.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Corners as projected by the camera, with noise, without drawing the picture: fast.
BoardPicture picture_of_corners(const testing::BoardCamera& camera,
                                const testing::BoardPlace& place, double noise_px,
                                std::uint64_t seed) {
  testing::Random random(seed);
  BoardPicture picture{.file = "board_" + std::to_string(seed) + ".jpg",
                       .width = camera.width,
                       .height = camera.height,
                       .corners = {}};
  for (int number = 0; number < kBoardCorners; ++number) {
    const Point at = board_corner(number);
    const Point seen = camera.seen(place.origin_mm + place.square_mm * place.rotation *
                                                         Eigen::Vector3d(at.x, at.y, 0));
    const Point noisy{seen.x + random.normal(0, noise_px), seen.y + random.normal(0, noise_px)};
    const bool is_inside =
        noisy.x > 0 && noisy.y > 0 && noisy.x < camera.width && noisy.y < camera.height;
    if (is_inside) picture.corners.push_back({number, noisy});
  }
  return picture;
}

std::vector<BoardPicture> pictures_of(const testing::BoardCamera& camera, int count,
                                      double most_tilt_deg, double noise_px, std::uint64_t seed) {
  testing::Random random(seed);
  std::vector<BoardPicture> pictures;
  for (int i = 0; i < count; ++i) {
    const Point middle{camera.width * random.uniform(.3, .7),
                       camera.height * random.uniform(.3, .7)};
    const double distance_mm = camera.focal_px / camera.width * random.uniform(420, 560);
    const auto tilt = [&] { return random.uniform(-most_tilt_deg, most_tilt_deg) * kDegree; };
    const auto place = testing::placed_board(distance_mm * camera.direction(middle), tilt(), tilt(),
                                             random.uniform(-.2, .2));
    pictures.push_back(picture_of_corners(camera, place, noise_px, random.seed() % 1000));
  }
  return pictures;
}

const testing::BoardCamera kBarrelCamera{
    .focal_px = 1234, .centre_x_px = 651, .centre_y_px = 419, .k1 = -.12};

TEST(LensFit, FindsTheLensThatTookThePictures) {
  const LensFit fit = fit_lens(pictures_of(kBarrelCamera, 10, 35, .1, 1));
  ASSERT_NE(fit.status, MeasureStatus::refused) << fit.reason;
  EXPECT_NEAR(fit.lens.focal_px.value, 1234, 4);
  EXPECT_NEAR(fit.lens.centre_x_px.value, 651, 2.5);
  EXPECT_NEAR(fit.lens.centre_y_px.value, 419, 2.5);
  EXPECT_NEAR(fit.lens.k1.value, -.12, .004);
  EXPECT_NEAR(*fit.error_px, .14, .03);  // of both coordinates
  EXPECT_LT(fit.lens.focal_px.uncertainty, 8);
  EXPECT_GT(fit.lens.focal_px.uncertainty, .3);
  ASSERT_EQ(fit.pictures.size(), 10U);
  EXPECT_NEAR(*fit.pictures[0].distance * 24, 450, 150);
}

TEST(LensFit, TakesNoMoreCoefficientsThanThePicturesDetermine) {
  const LensFit one = fit_lens(pictures_of(kBarrelCamera, 10, 35, .1, 2));
  EXPECT_NE(one.lens.k1.value, 0);
  EXPECT_EQ(one.lens.k3.value, 0);
  EXPECT_EQ(one.lens.p1.value, 0);
  testing::BoardCamera plain = kBarrelCamera;
  plain.k1 = 0;
  EXPECT_FALSE(fit_lens(pictures_of(plain, 10, 35, .1, 3)).lens.is_distorted());
}

TEST(LensFitAccuracy, IntervalsHoldTheTruth) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const LensFit fit = fit_lens(pictures_of(kBarrelCamera, 8, 35, .2, 100 + seed));
    const auto count = [&](const LensNumber& number, double truth) {
      ++all;
      held += std::abs(number.value - truth) <= number.uncertainty ? 1 : 0;
    };
    count(fit.lens.focal_px, kBarrelCamera.focal_px);
    count(fit.lens.centre_x_px, kBarrelCamera.centre_x_px);
    count(fit.lens.centre_y_px, kBarrelCamera.centre_y_px);
    count(fit.lens.k1, kBarrelCamera.k1);
  }
  EXPECT_EQ(all, 48);
  EXPECT_GE(held, 42);  // at 95 %, fewer have a probability below 1 %
}

TEST(LensFit, RefusesTooFewPicturesAndThoseWithoutABoard) {
  std::vector<BoardPicture> pictures = pictures_of(kBarrelCamera, 6, 35, .1, 4);
  pictures[0].corners.clear();
  pictures[1].corners.resize(5);
  const LensFit fit = fit_lens(pictures);
  EXPECT_EQ(fit.status, MeasureStatus::refused);
  EXPECT_THAT(fit.reason,
              AllOf(HasSubstr("4 of 6 pictures"), HasSubstr("Rule: 5"), HasSubstr("Fix")));
  EXPECT_FALSE(fit.pictures[0].is_used);
  EXPECT_EQ(fit.pictures[1].corners, 5);
  EXPECT_EQ(fit_lens({}).status, MeasureStatus::refused);
}

TEST(LensFit, RefusesPicturesOfDifferentSizesByName) {
  std::vector<BoardPicture> pictures = pictures_of(kBarrelCamera, 8, 35, .1, 5);
  std::swap(pictures[3].width, pictures[3].height);
  pictures[3].file = "upright.jpg";
  EXPECT_THAT(fit_lens(pictures).reason,
              AllOf(HasSubstr("different sizes"), HasSubstr("853 x 1280: upright.jpg")));
}

TEST(LensFit, RefusesBoardsThatAllFaceTheSameWay) {
  EXPECT_THAT(fit_lens(pictures_of(kBarrelCamera, 8, 3, .1, 6)).reason,
              HasSubstr("all boards face the same way"));
}

TEST(LensFit, RefusesBoardsThatCoverLittle) {
  std::vector<BoardPicture> pictures;
  for (int i = 0; i < 8; ++i) {
    const auto place = testing::placed_board({0, 0, 1500}, .1 * i - .4, .3 - .08 * i, 0);
    pictures.push_back(picture_of_corners(kBarrelCamera, place, .1, static_cast<std::uint64_t>(i)));
  }
  EXPECT_THAT(fit_lens(pictures).reason, HasSubstr("cover only"));
}

TEST(LensFit, RefusesCornersThatNoLensPutsThere) {
  std::vector<BoardPicture> pictures = pictures_of(kBarrelCamera, 8, 35, .1, 7);
  for (BoardPicture& picture : pictures) {  // a wavy sheet
    for (SeenCorner& corner : picture.corners) corner.place.y += 3 * (corner.number % 3 - 1);
  }
  EXPECT_THAT(fit_lens(pictures).reason,
              AllOf(HasSubstr("px from where any lens would have them"), HasSubstr("board_")));
}

}  // namespace
}  // namespace repose::vision
