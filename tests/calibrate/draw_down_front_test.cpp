#include "calibrate/experiment/draw_down_front.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "dem/experiment/draw_down.h"
#include "tests/dem/experiment_model.h"

namespace repose::calibrate {
namespace {

/// Balls of 4 mm whose tops follow a line above a floor.
void add_under(render::Scene& scene, double floor_m, double from_m, double to_m,
               const std::function<double(double)>& height_m) {
  constexpr double kRadius = .002;
  for (int k = static_cast<int>(std::ceil(from_m / kRadius)); k * kRadius <= to_m; ++k) {
    const double top = height_m(k * kRadius);
    if (top < kRadius) continue;
    scene.grains.push_back({.shape = 0,
                            .number = static_cast<int>(scene.grains.size()),
                            .pose = {.position = {k * kRadius, 0, floor_m + top - kRadius},
                                     .orientation = dem::Quaternion::Identity()}});
  }
}

constexpr dem::DrawDownProtocol kDrawn{
    .length_m = .3, .depth_m = .05, .slot_m = .04, .fill_m = .12, .drop_m = .15};

struct Degrees {
  double lower_left = 0;
  double lower_right = 0;
  std::optional<double> upper_left, upper_right;
};

render::Scene scene_of(const Degrees& angles) {
  render::Scene scene;
  scene.shapes = {dem::sphere_shape(.002)};
  const auto slope = [](double degrees) { return std::tan(degrees * kDegree); };
  const double floor_m = dem::upper_floor_m(kDrawn);
  add_under(scene, 0, -.148, .148, [&](double x) {
    return .06 - std::abs(x) * slope(x < 0 ? angles.lower_left : angles.lower_right);
  });
  if (angles.upper_left) {
    add_under(scene, floor_m, -.148, -.02,
              [&](double x) { return (-x - .02) * slope(*angles.upper_left); });
  }
  if (angles.upper_right) {
    add_under(scene, floor_m, .02, .148,
              [&](double x) { return (x - .02) * slope(*angles.upper_right); });
  }
  return scene;
}

DrawDownFront front_of(const Degrees& angles) {
  return draw_down_front(scene_of(angles), dem::front_of(kDrawn));
}

TEST(DrawDownFront, ShowsTheAnglesOfKnownSlopes) {
  const DrawDownFront front = front_of({25, 25, 35, 35});
  EXPECT_NEAR(front.lower_angle_deg.value(), 25, .3);
  EXPECT_NEAR(front.upper_angle_deg.value(), 35, .3);
}

TEST(DrawDownFront, ItsLinesLieOnTheSlopesInThePicture) {
  const DrawDownFront front = front_of({22, 28, 30, 40});
  const std::vector<std::string> names = {"upper left", "upper right", "lower left", "lower right"};
  const std::vector<double> angles_deg = {30, 40, 22, 28};
  ASSERT_EQ(front.slopes.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const vision::Slope& slope = front.slopes[k];
    EXPECT_EQ(slope.name, names[k]);
    ASSERT_TRUE(slope.angle_rad) << names[k];
    EXPECT_NEAR(*slope.angle_rad / kDegree, angles_deg[k], .4) << names[k];
    const auto& [from, to] = slope.line;
    const double drawn_deg = std::atan(std::abs((to.y - from.y) / (to.x - from.x))) / kDegree;
    EXPECT_NEAR(drawn_deg, angles_deg[k], .4) << names[k];
    // The edge is where the picture turns dark below the line.
    const double x = (from.x + to.x) / 2, y = (from.y + to.y) / 2;
    const auto grey = [&](double row) {
      const auto at =
          std::lround(std::floor(row)) * front.picture.width + std::lround(std::floor(x));
      return static_cast<int>(front.picture.bgr[static_cast<std::size_t>(3 * at)]);
    };
    EXPECT_GT(grey(y - 10), 128) << names[k];
    EXPECT_LT(grey(y + 10), 128) << names[k];
  }
}

TEST(DrawDownFront, IsTheSameMirrored) {
  const DrawDownFront one = front_of({22, 28, 30, 40});
  const DrawDownFront mirrored = front_of({28, 22, 40, 30});
  EXPECT_NEAR(one.lower_angle_deg.value(), 25, .4);
  EXPECT_NEAR(one.upper_angle_deg.value(), 35, .4);
  EXPECT_NEAR(mirrored.lower_angle_deg.value(), one.lower_angle_deg.value(), .1);
  EXPECT_NEAR(mirrored.upper_angle_deg.value(), one.upper_angle_deg.value(), .1);
}

TEST(DrawDownFront, ASideWithoutASlopeIsLeftOut) {
  EXPECT_NEAR(front_of({25, 25, 33, {}}).upper_angle_deg.value(), 33, .3);
  const DrawDownFront bare = front_of({25, 25, {}, {}});
  EXPECT_FALSE(bare.upper_angle_deg);
  EXPECT_FALSE(bare.slopes.front().angle_rad);
  EXPECT_TRUE(bare.slopes.back().angle_rad);
  render::Scene empty;
  empty.shapes = {dem::sphere_shape(.002)};
  EXPECT_THROW(draw_down_front(empty, dem::front_of(kDrawn)), base::InputError);
  EXPECT_THROW(draw_down_front({}, dem::front_of(kDrawn)), base::InputError);
}

TEST(DrawDownFront, SteepSlopesHaveAnAngleToo) {
  EXPECT_NEAR(front_of({25, 25, 70, 70}).upper_angle_deg.value(), 70, 1);
}

constexpr dem::DrawDownProtocol kBoxes{
    .length_m = .44, .depth_m = .08, .slot_m = .11, .fill_m = .08, .drop_m = .14};

/// About this many grains lie side by side on each side of the slot.
constexpr int kSlopeGrains = 7;

/// Balls of 20 mm, soft to keep the run short.
dem::Repeat simulated(int seed) {
  dem::Model model = dem::test::sphere_bench();
  model.grain = dem::sphere_shape(.01);
  model.grain_material = {"ball", 1000, 1e6, .3};
  model.grain_grain = {.3, .4, .03};
  return dem::run_draw_down(model, kBoxes, seed);
}

/// A silhouette of the selected grains.
vision::Picture drawn(const dem::Simulation& simulation,
                      const std::function<bool(const dem::Vector&)>& is_shown) {
  render::Scene scene = render::scene_of(simulation);
  std::erase_if(scene.grains,
                [&](const render::PlacedGrain& grain) { return !is_shown(grain.pose.position); });
  render::Renderer renderer;
  return HeapViewSession(std::move(scene), {.views = 1}).take(renderer, 0).picture;
}

/// The picture of a slope up to one grain before its side wall, so that the wall is not taken for a
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

struct Measured {
  std::optional<double> lower_rad;
  std::optional<double> upper_left_rad, upper_right_rad;
};

/// As measured in photographs of the heap and of each slope.
Measured measured(const dem::Simulation& simulation) {
  const auto upper = [&](bool is_left) {
    const vision::Picture picture = drawn(simulation, [is_left](const dem::Vector& place) {
      return place.z() > kBoxes.drop_m && (place.x() < 0) == is_left;
    });
    return vision::measure_repose_angle(up_to_the_wall(picture, is_left)).angle_rad;
  };
  const vision::Picture heap =
      drawn(simulation, [](const dem::Vector& place) { return place.z() < kBoxes.drop_m; });
  return {vision::measure_repose_angle(heap).angle_rad, upper(true), upper(false)};
}

// With so few grains, some slopes are round and rejected in pictures.
TEST(DrawDownFront, PhotographsOfTheHeapAndTheSlopesShowTheSame) {
  for (int seed = 1; seed <= 12; ++seed) {
    const dem::Repeat repeat = simulated(seed);
    const Measured photo = measured(*repeat.state);
    if (!photo.lower_rad || !photo.upper_left_rad || !photo.upper_right_rad) continue;
    const DrawDownFront front =
        draw_down_front(render::scene_of(*repeat.state), dem::front_of(kBoxes));
    EXPECT_NEAR(*photo.lower_rad / kDegree, front.lower_angle_deg.value(), .5);
    const double upper_rad = (*photo.upper_left_rad + *photo.upper_right_rad) / 2;
    EXPECT_NEAR(upper_rad / kDegree, front.upper_angle_deg.value(), .5);
    return;
  }
  FAIL() << "no run has slopes that can all be measured in photographs";
}

}  // namespace
}  // namespace repose::calibrate
