#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/experiment/heap_views.h"
#include "calibrate/experiment/position_angle.h"
#include "tests/dem/experiment_model.h"

namespace repose::calibrate {
namespace {

using dem::ClumpSphere;
using ::testing::ElementsAre;
using ::testing::Key;

constexpr double kDegree = std::numbers::pi / 180;

/// What stays to the right of a slot (mirrored: to its left) under a slope, 8 cm long.
dem::HeapEnvelope slope(double angle_deg, bool is_left) {
  constexpr double kRadius = .002;
  std::vector<ClumpSphere> spheres;
  for (int k = 0; k <= 40; ++k) {
    const double from_slot = k * kRadius;
    const double top = from_slot * std::tan(angle_deg * kDegree);
    if (top < kRadius) continue;
    spheres.push_back(
        {.centre = {is_left ? -from_slot : from_slot, 0, top - kRadius}, .radius = kRadius});
  }
  return dem::heap_envelopes(spheres, 1).front();
}

/// A heap whose flanks differ.
dem::HeapEnvelope heap(double left_deg, double right_deg) {
  std::vector<ClumpSphere> spheres;
  for (int k = -100; k <= 100; ++k) {
    const double x = k * 1e-3;
    const double top = .06 - std::abs(x) * std::tan((x < 0 ? left_deg : right_deg) * kDegree);
    if (top > .002) spheres.push_back({.centre = {x, 0, top - .002}, .radius = .002});
  }
  return dem::heap_envelopes(spheres, 1).front();
}

dem::Repeat with_angles(dem::DrawDownOutlines outlines) {
  dem::Repeat repeat;
  repeat.value = 70;
  repeat.draw_down = std::move(outlines);
  add_draw_down_angles(repeat);
  return repeat;
}

TEST(DrawDownAngles, AreThoseOfKnownSlopes) {
  const dem::Repeat repeat = with_angles({heap(25, 25), slope(35, true), slope(35, false)});
  EXPECT_NEAR(repeat.readings.at("lower_angle_deg"), 25, .3);
  EXPECT_NEAR(repeat.readings.at("upper_angle_deg"), 35, .3);
  EXPECT_EQ(repeat.value, 70);
  EXPECT_FALSE(repeat.draw_down);
  EXPECT_THAT(repeat.readings, ElementsAre(Key("lower_angle_deg"), Key("upper_angle_deg")));
}

TEST(DrawDownAngles, AreMeansOfLeftAndRightAndTheSameMirrored) {
  const dem::Repeat one = with_angles({heap(22, 28), slope(30, true), slope(40, false)});
  const dem::Repeat mirrored = with_angles({heap(28, 22), slope(40, true), slope(30, false)});
  EXPECT_NEAR(one.readings.at("lower_angle_deg"), 25, .4);
  EXPECT_NEAR(one.readings.at("upper_angle_deg"), 35, .3);
  for (const char* name : {"lower_angle_deg", "upper_angle_deg"}) {
    EXPECT_NEAR(mirrored.readings.at(name), one.readings.at(name), .1) << name;
  }
}

TEST(DrawDownAngles, ASideWithoutASlopeIsLeftOut) {
  EXPECT_NEAR(with_angles({heap(25, 25), slope(33, true), {}}).readings.at("upper_angle_deg"), 33,
              .3);
  EXPECT_TRUE(std::isnan(with_angles({heap(25, 25), {}, {}}).readings.at("upper_angle_deg")));
}

constexpr dem::DrawDownProtocol kBoxes{
    .length_m = .44, .depth_m = .08, .slot_m = .11, .fill_m = .08, .drop_m = .14};

/// About as many lie side by side on a side of the slot.
constexpr int kSlopeGrains = 7;

/// Balls of 20 mm, soft so that the run is short.
dem::Repeat simulated() {
  dem::Model model = dem::test::sphere_bench();
  model.grain = dem::sphere_shape(.01);
  model.grain_material = {"ball", 1000, 1e6, .3};
  model.grain_grain = {.3, .4, .03};
  // (steeper slopes of so few grains are round, and refused in pictures)
  return dem::run_draw_down(model, kBoxes, 1);
}

/// A silhouette of some of the grains.
vision::Picture drawn(const dem::Simulation& simulation,
                      const std::function<bool(const dem::Vector&)>& is_shown) {
  render::Scene scene = render::scene_of(simulation);
  std::erase_if(scene.grains,
                [&](const render::PlacedGrain& grain) { return !is_shown(grain.pose.position); });
  render::Renderer renderer;
  return HeapViewSession(std::move(scene), 1).take(renderer, 0).picture;
}

/// The part of a slope's picture that ends a grain before its side wall, so that the wall is no
/// flank.
vision::Picture up_to_the_wall(const vision::Picture& picture, bool is_left) {
  int first = picture.width, last = 0;
  for (std::size_t k = 0; k < picture.bgr.size(); k += 3) {
    if (picture.bgr[k] > 127) continue;
    const int column = static_cast<int>(k / 3) % picture.width;
    first = std::min(first, column);
    last = std::max(last, column);
  }
  const int grain_px = (last - first) / kSlopeGrains;
  const int from = is_left ? first + grain_px : 0;
  const int to = is_left ? picture.width : last - grain_px;
  return vision::part_of(picture,
                         {.x = from, .y = 0, .width = to - from, .height = picture.height});
}

TEST(DrawDownAngles, PicturesOfTheHeapAndTheSlopesShowTheSame) {
  dem::Repeat repeat = simulated();
  add_draw_down_angles(repeat);
  const auto lower = vision::measure_repose_angle(
      drawn(*repeat.state, [](const dem::Vector& place) { return place.z() < kBoxes.drop_m; }));
  ASSERT_TRUE(lower.angle_rad) << lower.reason;
  EXPECT_NEAR(*lower.angle_rad / kDegree, repeat.readings.at("lower_angle_deg"), .5);
  double sum = 0;
  for (const bool is_left : {true, false}) {
    const vision::Picture picture = drawn(*repeat.state, [is_left](const dem::Vector& place) {
      return place.z() > kBoxes.drop_m && (place.x() < 0) == is_left;
    });
    const auto slope = vision::measure_repose_angle(up_to_the_wall(picture, is_left));
    ASSERT_TRUE(slope.angle_rad) << slope.reason;
    sum += *slope.angle_rad / kDegree;
  }
  EXPECT_NEAR(sum / 2, repeat.readings.at("upper_angle_deg"), .5);
}

}  // namespace
}  // namespace repose::calibrate
