#include "vision/camera/board_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <gmock/gmock.h>

#include "base/units.h"
#include "tests/support/drawn_board.h"
#include "tests/support/heap_random.h"
#include "vision/camera/board_view.h"
#include "vision/camera/heap_view.h"

namespace repose::vision {
namespace {

constexpr double kNormal95 = 1.96;

const testing::BoardCamera kCamera;

Lens known_lens(double focal_uncertainty_px = 5) {
  return {.width = kCamera.width,
          .height = kCamera.height,
          .focal_px = {kCamera.focal_px, focal_uncertainty_px},
          .centre_x_px = {kCamera.centre_x_px, 2},
          .centre_y_px = {kCamera.centre_y_px, 2},
          .k1 = {},
          .k2 = {},
          .p1 = {},
          .p2 = {},
          .k3 = {}};
}

/// Corners of an upright board in front of a camera that looks down and is rolled.
std::vector<SeenCorner> corners_of(double pitch_rad, double roll_rad, double distance_mm,
                                   double noise_px, std::uint64_t seed, double in_plane_rad = 0) {
  testing::Random random(seed);
  const auto upright = testing::placed_board({0, 0, 0}, 0, 0, in_plane_rad);
  Eigen::Matrix3d world_from_level;
  world_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Matrix3d view = testing::camera_from_world(pitch_rad, roll_rad) * world_from_level;
  testing::BoardPlace place = upright;
  place.rotation = view * upright.rotation;
  place.origin_mm = view * upright.origin_mm + Eigen::Vector3d(100, 30, distance_mm);
  std::vector<SeenCorner> corners;
  for (int number = 0; number < kBoardCorners; ++number) {
    const Point at = board_corner(number);
    const Point seen = kCamera.seen(place.origin_mm + place.square_mm * place.rotation *
                                                          Eigen::Vector3d(at.x, at.y, 0));
    corners.push_back(
        {number, {seen.x + random.normal(0, noise_px), seen.y + random.normal(0, noise_px)}});
  }
  return corners;
}

HeapView view_of(const BoardPose& pose) { return view_by_board(pose.numbers, {.square_mm = 24}); }

TEST(BoardPose, ExactCornersGiveTheCamerasPitchRollAndDistance) {
  for (const double pitch_deg : {-3., 0., 8.}) {
    for (const double roll_deg : {-2., 4.}) {
      const auto corners = corners_of(pitch_deg * kDegree, roll_deg * kDegree, 1200, 0, 1);
      const BoardPose pose = fit_pose(corners, known_lens(0), kCamera.width, kCamera.height);
      const HeapView view = view_of(pose);
      EXPECT_NEAR(view.pitch_rad() / kDegree, pitch_deg, .01);
      EXPECT_NEAR(view.roll_rad() / kDegree, roll_deg, .01);
      // Distance of the plane, along its normal: the board's middle is 1200 mm ahead on the axis.
      EXPECT_NEAR(
          view.distance_mm,
          1200 * std::cos(pitch_deg * kDegree) - view.normal.dot(Eigen::Vector3d(-100, -30, 0)),
          1.5);
      EXPECT_LT(pose.error_px, 1e-3);
    }
  }
}

TEST(BoardPose, ABoardOnItsSideOrUpsideDownTellsTheSame) {
  for (const double turn : {std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2}) {
    const auto corners = corners_of(5 * kDegree, 0, 1000, 0, 1, turn);
    const HeapView view = view_of(fit_pose(corners, known_lens(0), kCamera.width, kCamera.height));
    EXPECT_NEAR(view.pitch_rad() / kDegree, 5, .01);
    EXPECT_NEAR(view.roll_rad() / kDegree, 0, .01);
  }
}

TEST(BoardPose, TheCovarianceIsThatOfManyNoisyCorners) {
  constexpr int kTimes = 60;
  int held = 0;
  for (int i = 0; i < kTimes; ++i) {
    const auto corners =
        corners_of(4 * kDegree, kDegree, 1400, .1, static_cast<std::uint64_t>(i) + 1);
    const BoardPose pose = fit_pose(corners, known_lens(0), kCamera.width, kCamera.height);
    const Eigen::MatrixXd variance =
        propagated({.values = pose.numbers, .covariance = pose.covariance},
                   [](const Eigen::VectorXd& numbers) -> Eigen::VectorXd {
                     return Eigen::VectorXd::Constant(
                         1, view_by_board(numbers, {.square_mm = 24}).pitch_rad());
                   });
    const double error = view_of(pose).pitch_rad() - 4 * kDegree;
    held += std::abs(error) <= kNormal95 * std::sqrt(variance(0, 0)) ? 1 : 0;
  }
  EXPECT_GE(held, 51);  // 57 expected; fewer than 51 have a probability of 1 %
}

TEST(BoardPose, WithoutALensThePitchIsUncertainAndTheScaleIsNot) {
  const auto corners = corners_of(4 * kDegree, 0, 1200, .1, 3);
  const BoardPose pose = fit_pose(corners, std::nullopt, kCamera.width, kCamera.height);
  const auto deviation = [&](const auto& number) {
    return std::sqrt(propagated({.values = pose.numbers, .covariance = pose.covariance},
                                [&](const Eigen::VectorXd& numbers) -> Eigen::VectorXd {
                                  return Eigen::VectorXd::Constant(
                                      1, number(view_by_board(numbers, {.square_mm = 24})));
                                })(0, 0));
  };
  const auto scale = [](const HeapView& view) { return view.distance_mm / view.focal_px; };
  EXPECT_GT(deviation([](const HeapView& view) { return view.pitch_rad(); }), kDegree / 2);
  EXPECT_LT(deviation(scale), .01 * scale(view_of(pose)));
  EXPECT_NEAR(scale(view_of(pose)), 1200 / kCamera.focal_px, .02);
}

TEST(BoardPose, OfASmallBoardOnlyASquareViewTellsTheTurn) {
  const double distance_mm = 8'000, pitch_rad = 3 * kDegree;
  const Point beside{kCamera.centre_x_px - 200, kCamera.centre_y_px};
  const auto scale = [&](const HeapView& view) { return mm_per_px_along(view, beside, {0, 1}); };
  const auto pitch = [](const HeapView& view) { return view.pitch_rad(); };
  double most_turned = 0, most_turned_square = 0;
  int held_pitch = 0, held_scale = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto corners = corners_of(pitch_rad, 0, distance_mm, .6, seed);
    const auto fitted = [&](std::optional<double> square_within_rad) {
      return fit_pose(corners, std::nullopt, kCamera.width, kCamera.height, square_within_rad);
    };
    const auto deviation = [&](const BoardPose& pose, const auto& number) {
      return std::sqrt(propagated({.values = pose.numbers, .covariance = pose.covariance},
                                  [&](const Eigen::VectorXd& numbers) -> Eigen::VectorXd {
                                    return Eigen::VectorXd::Constant(
                                        1, number(view_by_board(numbers, {.square_mm = 24})));
                                  })(0, 0));
    };
    most_turned = std::max(most_turned, deviation(fitted({}), pitch));
    const BoardPose square = fitted(10 * kDegree);
    const HeapView view = view_of(square);
    most_turned_square = std::max(most_turned_square, deviation(square, pitch));
    const auto holds = [&](double error, double sd) { return std::abs(error) <= kNormal95 * sd; };
    held_pitch += holds(pitch(view) - pitch_rad, deviation(square, pitch)) ? 1 : 0;
    held_scale +=
        holds(scale(view) - distance_mm / kCamera.focal_px, deviation(square, scale)) ? 1 : 0;
  }
  EXPECT_GT(most_turned, 10 * kDegree);
  EXPECT_LT(most_turned_square, 10 * kDegree);
  EXPECT_GE(held_pitch, 26);
  EXPECT_GE(held_scale, 26);
}

TEST(HeapView, ThePropagatedVarianceOfASumOfRelatedInputsIsExact) {
  Eigen::MatrixXd covariance(2, 2);
  covariance << 4, 3, 3, 9;
  const auto sum = [](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, 2 * values[0] - values[1]);
  };
  EXPECT_NEAR(propagated({.values = Eigen::Vector2d(1, 2), .covariance = covariance}, sum)(0, 0),
              4 * 4 + 9 - 2 * 2 * 3, 1e-9);
}

}  // namespace
}  // namespace repose::vision
