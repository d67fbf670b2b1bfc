#include "vision/measure/definitions.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "tests/support/heap_profile.h"
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

std::vector<NamedAngle> other_definitions_of(const Reading& reading) {
  return other_definitions({reading.profile, reading.left, reading.right, reading.grain});
}

double angle_named(const std::vector<NamedAngle>& angles, const std::string& name) {
  for (const NamedAngle& angle : angles) {
    if (angle.name == name) return angle.angle_rad;
  }
  ADD_FAILURE() << name << " is missing";
  return 0;
}

/// The feet are at the profile's two ends.
Profile triangle_profile(double left_rad, double right_rad, double height) {
  const double left = height / std::tan(left_rad);
  const double right = height / std::tan(right_rad);
  return profile_of(static_cast<int>(left + right),
                    Triangle{left, height, std::tan(left_rad), std::tan(right_rad)});
}

TEST(OtherDefinitions, AllAgreeOnATriangle) {
  const auto angles =
      other_definitions_of(fitted_reading(triangle_profile(25 * kDegree, 25 * kDegree, 150)));
  // The profile's ends are half a column inside the feet.
  EXPECT_NEAR(angle_named(angles, "height_over_base"), 25 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), 25 * kDegree, 1e-6);
  EXPECT_NEAR(angle_named(angles, "whole_flank"), 25 * kDegree, 1e-6);
}

TEST(OtherDefinitions, AreMeansOfTheTwoSides) {
  const auto angles =
      other_definitions_of(fitted_reading(triangle_profile(20 * kDegree, 32 * kDegree, 150)));
  EXPECT_NEAR(angle_named(angles, "height_over_base"), 26 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), 26 * kDegree, 1e-6);
}

TEST(OtherDefinitions, ARoundedCrestLowersHeightOverBase) {
  Triangle shape{300, 150, 0.5, 0.5};
  const auto angles = other_definitions_of(
      fitted_reading(profile_of(600, [&](double along) { return std::min(120.0, shape(along)); })));
  EXPECT_NEAR(angle_named(angles, "height_over_base"), std::atan(120.0 / 300), 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
}

TEST(OtherDefinitions, AHollowToeLowersTheWholeFlankAlone) {
  const auto hollow = [](double along) {
    const double h = Triangle{300, 150, 0.5, 0.5}(along);
    return h > 30 ? h : std::max(0.0, 30 - 0.25 * (std::abs(along - 300) - 240));
  };
  const auto angles = other_definitions_of(fitted_reading(profile_of(700, hollow)));
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
  EXPECT_LT(angle_named(angles, "whole_flank"), std::atan(0.5) - 1 * kDegree);
}

TEST(OtherDefinitions, OneFlankIsEnough) {
  Profile half = profile_of(300, Triangle{0, 150, 1, 0.5});
  const Reading reading = fitted_reading(half);
  ASSERT_NE(reading.left.status, FlankStatus::ok);
  const auto angles = other_definitions_of(reading);
  EXPECT_NEAR(angle_named(angles, "height_over_base"), std::atan(0.5), 0.1 * kDegree);
  EXPECT_NEAR(angle_named(angles, "half_height_tangent"), std::atan(0.5), 1e-6);
}

TEST(OtherDefinitions, NoFlankHasNone) { EXPECT_TRUE(other_definitions_of(Reading{}).empty()); }

TEST(OtherDefinitions, SayWhatTheyAre) {
  std::set<std::string> names;
  for (const auto& angle : other_definitions_of(fitted_reading(triangle_profile(0.5, 0.5, 150)))) {
    EXPECT_FALSE(angle.description.empty()) << angle.name;
    EXPECT_TRUE(names.insert(angle.name).second) << angle.name << " twice";
  }
}

/// Angle of the line fitted to a side's ideal curve, between two fractions of the height.
double line_of_curve(const testing::HeapProfile& heap, bool is_left,
                     const std::array<double, 2>& window) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : heap.curve()) {
    const bool is_inside =
        p.y >= window[0] * heap.height_px() && p.y <= window[1] * heap.height_px();
    if ((p.x < heap.apex_x()) != is_left || !is_inside) continue;
    n += 1, x += p.x, y += p.y, xx += p.x * p.x, xy += p.x * p.y;
  }
  return std::abs(std::atan((n * xy - x * y) / (n * xx - x * x)));
}

/// By the ideal outline; height over base by the grains' own, whose base is a few grains shorter.
double true_angle(const testing::HeapProfile& ideal, const testing::DrawnHeap& heap,
                  const base::AngleDefinition& definition) {
  if (definition.name == "height_over_base") {
    const double left = ideal.apex_x() - heap.outline.front().x;
    const double right = heap.outline.back().x - ideal.apex_x();
    return (std::atan(heap.height_px / left) + std::atan(heap.height_px / right)) / 2;
  }
  return (line_of_curve(ideal, true, definition.window) +
          line_of_curve(ideal, false, definition.window)) /
         2;
}

/// The intervals account for grains' bumps, segmentation and ground line.
TEST(NamedDefinitions, IntervalsHoldTheIdealOutlinesAngle) {
  constexpr std::uint64_t kSeeds = 8;
  constexpr int kAll = 4 * kSeeds, kFewest = kAll - 4;
  std::map<std::string, int> held;
  for (const char* condition : {"clean", "asymmetric", "silhouette", "uneven_light"}) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      testing::HeapScene scene = testing::condition_named(condition).scene(seed);
      scene.height = scene.height * kUsualWidth / scene.width;
      scene.width = kUsualWidth;
      const testing::HeapProfile ideal(scene.form, scene.width, 0);
      const testing::DrawnHeap heap = testing::draw_heap(scene);
      for (const NamedAngle& named : measure_repose_angle(heap.picture).definitions) {
        const double truth = true_angle(ideal, heap, *base::find_definition(named.name));
        held[named.name] += std::abs(named.angle_rad - truth) <= *named.uncertainty_rad ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(held.size(), base::kAngleDefinitions.size() - 1);
  for (const auto& [name, count] : held) EXPECT_GE(count, kFewest) << name << ", of " << kAll;
}

TEST(NamedDefinitions, TheOneThatIsNamedIsTheNumber) {
  const testing::DrawnHeap heap = drawn("asymmetric", 3, kUsualWidth);
  const ReposeAngle usual = measure_repose_angle(heap.picture);
  EXPECT_EQ(usual.definition, base::kUsualDefinition.name);
  ASSERT_EQ(usual.definitions.size(), base::kAngleDefinitions.size() - 1);
  for (const NamedAngle& other : usual.definitions) {
    MeasureOptions options;
    options.definition = other.name;
    const ReposeAngle named = measure_repose_angle(heap.picture, options);
    EXPECT_EQ(named.definition, other.name);
    EXPECT_EQ(named.window, base::find_definition(other.name)->window);
    EXPECT_EQ(named.angle_rad, other.angle_rad) << other.name;
    EXPECT_EQ(named.uncertainty_rad, other.uncertainty_rad) << other.name;
    EXPECT_NEAR(*named.angle_rad, (*named.left.angle_rad + *named.right.angle_rad) / 2, 1e-12);
    EXPECT_EQ(angle_by(named, base::kUsualDefinition.name), usual.angle_rad);
    EXPECT_EQ(angle_by(usual, other.name), named.angle_rad);
  }
}

TEST(NamedDefinitions, AFootBeyondTheFrameHasNoHeightOverBase) {
  testing::HeapScene scene = testing::condition_named("truncated").scene(1);
  testing::HeapForm& form = scene.form;
  ASSERT_EQ(form.cut, testing::Side::left);
  form.cut_height = .25;  // all but a twelfth of the default window is visible
  const double cot_left = 1 / std::tan(form.left_rad);
  const double height = form.base / (cot_left + 1 / std::tan(form.right_rad));
  form.center = form.base / 2 - form.cut_height * height * cot_left;
  const testing::DrawnHeap heap = testing::draw_heap(scene);
  MeasureOptions options;
  options.definition = "height_over_base";
  const ReposeAngle whole = measure_repose_angle(heap.picture);
  const ReposeAngle named = measure_repose_angle(heap.picture, options);
  EXPECT_TRUE(whole.angle_rad) << whole.reason;
  for (const NamedAngle& other : whole.definitions) EXPECT_NE(other.name, options.definition);
  EXPECT_EQ(named.status, MeasureStatus::refused);
  EXPECT_FALSE(named.angle_rad);
  EXPECT_NE(named.reason.find("height_over_base"), std::string::npos) << named.reason;
  EXPECT_NE(named.reason.find("Fix: "), std::string::npos);
}

TEST(NamedDefinitions, WhatCannotBeMeantIsRefused) {
  const auto faults = [](const MeasureOptions& options) { return options.problems().size(); };
  MeasureOptions options;
  options.definition = "cone";
  EXPECT_EQ(faults(options), 1);
  options.definition = "whole_flank";
  EXPECT_EQ(faults(options), 0);
  options.window_from = .1;
  EXPECT_EQ(faults(options), 1) << "it has its own window";
  options.window_from = .2;
  options.method = Method::paper;
  EXPECT_EQ(faults(options), 1) << "that method has its own line";
  options.definition = base::kUsualDefinition.name;
  EXPECT_EQ(faults(options), 1) << "likewise";
}

}  // namespace
}  // namespace repose::vision
