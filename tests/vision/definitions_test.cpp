#include "vision/measure/definitions.h"

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/vision/pictures.h"
#include "tests/vision/profiles.h"

namespace repose::vision {
namespace {

Reading fitted_reading(const Profile& profile) {
  Reading reading;
  reading.profile = profile;
  reading.left = fit_flank(profile, Side::left, {});
  reading.right = fit_flank(profile, Side::right, {});
  return reading;
}

double angle_named(const std::vector<NamedAngle>& angles, const std::string& name) {
  for (const NamedAngle& angle : angles) {
    if (angle.name == name) return angle.angle_rad;
  }
  ADD_FAILURE() << name << " is missing";
  return 0;
}

/// Feet at the profile's two ends.
Profile triangle_profile(double left_rad, double right_rad, double height) {
  const double left = height / std::tan(left_rad);
  const double right = height / std::tan(right_rad);
  return profile_of(static_cast<int>(left + right),
                    Triangle{left, height, std::tan(left_rad), std::tan(right_rad)});
}

TEST(OtherDefinitions, AllAgreeOnATriangle) {
  const auto angles =
      other_definitions(fitted_reading(triangle_profile(25 * kDegree, 25 * kDegree, 150)));
  // The profile's ends are half a column inside the feet.
  EXPECT_NEAR(angle_named(angles, "height_over_base"), 25 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), 25 * kDegree, 1e-6);
  EXPECT_NEAR(angle_named(angles, "whole_flank"), 25 * kDegree, 1e-6);
}

TEST(OtherDefinitions, AreMeansOfTheTwoSides) {
  const auto angles =
      other_definitions(fitted_reading(triangle_profile(20 * kDegree, 32 * kDegree, 150)));
  EXPECT_NEAR(angle_named(angles, "height_over_base"), 26 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), 26 * kDegree, 1e-6);
}

TEST(OtherDefinitions, ARoundedCrestLowersHeightOverBase) {
  Triangle shape{300, 150, 0.5, 0.5};
  const auto angles = other_definitions(
      fitted_reading(profile_of(600, [&](double along) { return std::min(120.0, shape(along)); })));
  EXPECT_NEAR(angle_named(angles, "height_over_base"), std::atan(120.0 / 300), 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
}

TEST(OtherDefinitions, AHollowToeLowersTheWholeFlankAlone) {
  const auto hollow = [](double along) {
    const double h = Triangle{300, 150, 0.5, 0.5}(along);
    return h > 30 ? h : std::max(0.0, 30 - 0.25 * (std::abs(along - 300) - 240));
  };
  const auto angles = other_definitions(fitted_reading(profile_of(700, hollow)));
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
  EXPECT_LT(angle_named(angles, "whole_flank"), std::atan(0.5) - 1 * kDegree);
}

TEST(OtherDefinitions, OneFlankIsEnough) {
  Profile half = profile_of(300, Triangle{0, 150, 1, 0.5});
  const Reading reading = fitted_reading(half);
  ASSERT_NE(reading.left.status, FlankStatus::ok);
  const auto angles = other_definitions(reading);
  EXPECT_NEAR(angle_named(angles, "height_over_base"), std::atan(0.5), 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
}

TEST(OtherDefinitions, NoFlankHasNone) { EXPECT_TRUE(other_definitions(Reading{}).empty()); }

TEST(OtherDefinitions, SayWhatTheyAre) {
  std::set<std::string> names;
  for (const auto& angle : other_definitions(fitted_reading(triangle_profile(0.5, 0.5, 150)))) {
    EXPECT_FALSE(angle.description.empty()) << angle.name;
    EXPECT_TRUE(names.insert(angle.name).second) << angle.name << " twice";
  }
}

}  // namespace
}  // namespace repose::vision
