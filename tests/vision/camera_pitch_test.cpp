#include "vision/measure/camera_pitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

/// Angle of the silhouette's side of a cone of slope `angle_rad`, by geometry alone.
///
/// A far camera that looks down by e maps (x, y, z), y away from it and z up, to
/// (x, z cos e + y sin e). The silhouette is the hull of the apex and of the base circle, so its
/// side is the flattest of the lines from the apex down to points of the circle's right half.
double silhouette_angle_rad(double angle_rad, double pitch_rad) {
  const double height = std::tan(angle_rad);  // of a cone of base radius 1
  const auto steepness = [&](double around) {
    const double x = std::cos(around);
    const double y = std::sin(around);
    return (height * std::cos(pitch_rad) - y * std::sin(pitch_rad)) / x;
  };
  // It has one minimum on the right half: ternary search, down to rounding.
  double low = -std::numbers::pi / 2;
  double high = std::numbers::pi / 2;
  for (int i = 0; i < 200; ++i) {
    const double third = (high - low) / 3;
    if (steepness(low + third) < steepness(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return std::atan(steepness((low + high) / 2));
}

TEST(CameraPitch, CorrectionUndoesTheProjectionOfACone) {
  for (const double angle_deg : {12.0, 20.0, 25.0, 35.0, 45.0}) {
    for (const double pitch_deg : {0.5, 2.0, 5.0, 8.0, 11.0}) {
      const double seen = silhouette_angle_rad(angle_deg * kDegree, pitch_deg * kDegree);
      EXPECT_LT(seen, angle_deg * kDegree);
      EXPECT_NEAR(angle_without_pitch(seen, pitch_deg * kDegree), angle_deg * kDegree, 1e-9)
          << angle_deg << " seen from " << pitch_deg;
    }
  }
}

/// The same from a camera `distance` base radii in front of the cone's axis, whose picture's middle
/// shows the axis `rise` below the apex: the flattest line from the apex to a point of the base.
double near_silhouette_rad(double angle_rad, double pitch_rad, double distance, double rise) {
  const double height = std::tan(angle_rad);
  const double eye_z = height - rise + distance * std::tan(pitch_rad);
  const auto in_picture = [&](double x, double y, double z) {
    const double away = y + distance;
    const double down = eye_z - z;
    const double depth = away * std::cos(pitch_rad) + down * std::sin(pitch_rad);
    const double up = away * std::sin(pitch_rad) - down * std::cos(pitch_rad);
    return Point{x / depth, up / depth};
  };
  const Point apex = in_picture(0, 0, height);
  double steepness = 1e9;
  constexpr int kRays = 100'000;
  for (int i = 1; i < kRays; ++i) {
    const double around = (i / double{kRays} - 0.5) * std::numbers::pi;
    const Point foot = in_picture(std::cos(around), std::sin(around), 0);
    steepness = std::min(steepness, (apex.y - foot.y) / foot.x);
  }
  return std::atan(steepness);
}

TEST(CameraPitch, CorrectionUndoesTheProjectionOfAConeNearby) {
  for (const double angle_deg : {15.0, 25.0, 35.0}) {
    for (const double pitch_deg : {-3.0, 0.0, 2.0, 9.0}) {
      for (const double distance : {3.0, 6.0, 20.0}) {
        const double angle = angle_deg * kDegree;
        const double pitch = pitch_deg * kDegree;
        const double rise = 0.6 * std::tan(angle);
        const double seen = near_silhouette_rad(angle, pitch, distance, rise);
        const double apex_pitch = std::atan(std::tan(pitch) - rise / distance);
        EXPECT_NEAR(angle_without_pitch(seen, pitch, apex_pitch), angle, 1e-7)
            << angle_deg << " seen from " << distance << ", " << pitch_deg;
      }
    }
  }
}

TEST(CameraPitch, CorrectionOfAFarCameraIsThatOfParallelRays) {
  EXPECT_NEAR(angle_without_pitch(0.4, 0.1, 0.1), angle_without_pitch(0.4, 0.1), 1e-14);
}

TEST(FarCameraError, CoversEveryCameraFromSixBaseRadiiOn) {
  for (const double angle_deg : {15.0, 25.0, 35.0}) {
    for (const double pitch_deg : {0.0, 3.0, 6.0, 10.0}) {
      const double angle = angle_deg * kDegree;
      const double pitch = pitch_deg * kDegree;
      const double rise = std::tan(angle) / 2;  // the camera looks at the heap's middle
      const auto off_rad = [&](double distance) {
        const double seen = near_silhouette_rad(angle, pitch, distance, rise);
        return std::abs(angle_without_pitch(seen, pitch) - angle);
      };
      const double nearest = near_silhouette_rad(angle, pitch, kNearestCamera, rise);
      const double bound = far_camera_error(nearest, pitch, rise);
      // The picture's radii and the axis's distance equal the heap's to within a few per cent.
      EXPECT_NEAR(off_rad(kNearestCamera), bound, 0.1 * bound) << angle_deg << ", " << pitch_deg;
      for (const double distance : {8.0, 15.0, 100.0}) EXPECT_LT(off_rad(distance), bound);
    }
  }
}

TEST(FarCameraError, IsNoneForAnApexInThePicturesMiddle) {
  EXPECT_NEAR(far_camera_error(0.4, 0, 0), 0, 1e-14);
  EXPECT_NEAR(far_camera_error(0.4, 0.1, 0), 0, 1e-14);
  EXPECT_GT(far_camera_error(0.4, 0.1, -0.3), 1e-3);
}

/// Bow of the base's near rim as seen by that camera, between its widest points in the picture:
/// that of the least-squares parabola, as in find_ground.
double near_bow(double angle_rad, double pitch_rad, double distance, double rise) {
  const double eye_z = std::tan(angle_rad) - rise + distance * std::tan(pitch_rad);
  const double widest = std::asin(1 / (distance + eye_z * std::tan(pitch_rad)));
  std::vector<Point> rim;
  constexpr int kPlaces = 20'000;
  for (int i = 0; i <= kPlaces; ++i) {
    const double around = std::numbers::pi + widest + (std::numbers::pi - 2 * widest) * i / kPlaces;
    const double away = std::sin(around) + distance;
    const double depth = away * std::cos(pitch_rad) + eye_z * std::sin(pitch_rad);
    const double down = eye_z * std::cos(pitch_rad) - away * std::sin(pitch_rad);
    rim.push_back({std::cos(around) / depth, down / depth});
  }
  const double reach = rim.back().x;
  double product = 0;
  double squares = 0;
  for (std::size_t i = 1; i < rim.size(); ++i) {  // integrals over the width, trapezoidal rule
    const double u = (rim[i].x + rim[i - 1].x) / 2 / reach;
    const double du = (rim[i].x - rim[i - 1].x) / reach;
    const double centred = u * u - 1.0 / 3;
    product += (rim[i].y + rim[i - 1].y) / 2 / reach * centred * du;
    squares += centred * centred * du;
  }
  return -product / squares / 2;
}

TEST(UntoldPitchError, CoversEveryCameraFromTheHeapsMiddleUp) {
  for (const double angle_deg : {15.0, 25.0, 35.0}) {
    for (const double pitch_deg : {0.0, 2.0, 5.0, 9.0}) {
      for (const double distance : {2.5, 4.0, 8.0, 100.0}) {
        const double angle = angle_deg * kDegree;
        const double pitch = pitch_deg * kDegree;
        const double rise = std::tan(angle) / 2;  // the camera looks at the heap's middle
        const double seen = near_silhouette_rad(angle, pitch, distance, rise);
        const double bow = near_bow(angle, pitch, distance, rise);
        EXPECT_LE(std::abs(angle - seen),
                  assumed_pitch_error(seen, pitch_from_bow(bow)) + 0.02 * kDegree)
            << angle_deg << " seen from " << distance << ", " << pitch_deg;
      }
    }
  }
}

TEST(UntoldPitchError, IsAFarCamerasCorrection) {
  for (const double pitch_deg : {2.0, 6.0}) {
    const double angle = 25 * kDegree;
    const double seen = near_silhouette_rad(angle, pitch_deg * kDegree, 1000, 0.2);
    const double bow = near_bow(angle, pitch_deg * kDegree, 1000, 0.2);
    EXPECT_NEAR(assumed_pitch_error(seen, pitch_from_bow(bow)), angle - seen, 0.01 * kDegree);
  }
}

TEST(CameraPitch, ChangesUsualAnglesLittle) {
  for (double angle_deg = 25; angle_deg <= 40; angle_deg += 5) {
    const auto change_deg = [&](double pitch_deg) {
      const double apparent = silhouette_angle_rad(angle_deg * kDegree, pitch_deg * kDegree);
      return (angle_without_pitch(apparent, pitch_deg * kDegree) - apparent) / kDegree;
    };
    EXPECT_LE(change_deg(5), 0.5);
    EXPECT_LE(change_deg(10), 2);
    EXPECT_GT(change_deg(10), 1);
  }
}

TEST(CameraPitch, LevelCameraNeedsNoCorrection) {
  EXPECT_EQ(angle_without_pitch(0.4, 0), 0.4);
  EXPECT_NEAR(angle_without_pitch(0.4, 1e-6), 0.4, 1e-11);
}

TEST(CameraPitch, LookingUpIsLookingDown) {
  EXPECT_EQ(angle_without_pitch(0.4, -0.1), angle_without_pitch(0.4, 0.1));
}

/// Bow of the least-squares parabola through a half ellipse of half width 1 and depth `depth`, by
/// summing over many points: u^2 less its mean 1/3 carries all the curvature.
double bow_of_half_ellipse(double depth) {
  double product = 0;
  double squares = 0;
  constexpr int kPlaces = 200'000;
  for (int i = 0; i < kPlaces; ++i) {
    const double u = 2 * (i + 0.5) / kPlaces - 1;
    const double centred = u * u - 1.0 / 3;
    product += depth * std::sqrt(1 - u * u) * centred;
    squares += centred * centred;
  }
  return -product / squares / 2;
}

TEST(PitchFromBow, IsThatOfTheBasesRim) {
  // A circle of radius 1 appears 2 wide; its near half lies up to sin e below its middle.
  for (const double pitch_deg : {0.0, 3.0, 10.0, 40.0}) {
    const double bow = bow_of_half_ellipse(std::sin(pitch_deg * kDegree));
    EXPECT_NEAR(pitch_from_bow(bow), pitch_deg * kDegree, 1e-6);  // sums of 200,000 points
  }
}

TEST(PitchFromBow, StaysWithinLevelAndUpright) {
  EXPECT_EQ(pitch_from_bow(-0.1), 0);
  EXPECT_NEAR(pitch_from_bow(0.7), 90 * kDegree, 1e-12);
}

}  // namespace
}  // namespace repose::vision
