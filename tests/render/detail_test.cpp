#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "render/truth.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using repose::testing::nut_heap;
using repose::testing::sphere_scene;

/// How far the mask's upper edge lies above the true one in each column, px, measured across the
/// edge where it is steep. The mask resolves its edge to half a pixel.
std::vector<double> edge_errors(const Scene& scene, const Camera& camera, const PictureSize& size,
                                Shown shown) {
  const Rendered drawn = renderer().draw(scene, camera, size, SilhouetteStyle{.shown = shown});
  std::vector<double> errors;
  const auto outline = truth_of(scene, camera, size, shown).outline;
  for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
    const vision::Point& point = outline[k];
    const auto x = static_cast<std::size_t>(point.x);
    std::size_t y = 0;
    while (y < static_cast<std::size_t>(size.height) &&
           drawn.grain_mask[y * static_cast<std::size_t>(size.width) + x] == 0) {
      ++y;
    }
    const double slope = (outline[k + 1].y - outline[k - 1].y) / 2;
    errors.push_back((point.y - static_cast<double>(y)) / std::hypot(1, slope));
  }
  return errors;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

constexpr double kFraction = .98;

/// Fraction of columns whose error is within half a pixel of rounding plus a quarter of a pixel.
double fraction_within_a_quarter(const std::vector<double>& errors) {
  const auto good = std::count_if(errors.begin(), errors.end(),
                                  [](double error) { return std::abs(error) <= .75; });
  return static_cast<double>(good) / static_cast<double>(errors.size());
}

TEST(Detail, AHeapsEdgeIsDrawnWithinAQuarterOfAPixel) {
  const Scene heap = nut_heap(14, .5, 4);
  for (const Shown shown : {Shown::mesh, Shown::spheres}) {
    for (const int width : {160, 640, 1920}) {
      const auto errors =
          edge_errors(heap, OrthographicCamera{.azimuth_rad = .7}, {width, width / 2}, shown);
      ASSERT_GT(errors.size(), static_cast<std::size_t>(width) / 2);
      // Rounding is unbiased: its mean is 0 to within .29 / sqrt(columns).
      EXPECT_NEAR(mean(errors), 0, .08) << width;
      // The rest are corners between two grains, where the edge has no unique slope.
      EXPECT_GT(fraction_within_a_quarter(errors), kFraction) << width;
    }
  }
}

TEST(Detail, AlsoThroughALens) {
  const Scene heap = nut_heap(14, .5, 4);
  const PictureSize size{1280, 720};
  PerspectiveCamera camera = camera_on({.distance_m = .6}, heap, size);
  camera.k1 = -.15;
  const auto errors = edge_errors(heap, camera, size, Shown::mesh);
  EXPECT_NEAR(mean(errors), 0, .08);
  EXPECT_GT(fraction_within_a_quarter(errors), kFraction);
}

TEST(Truth, ASpheresOutlineIsItsUpperHalf) {
  const Scene scene = sphere_scene(.1, {{0, 0, 0}});
  const OrthographicCamera camera{.mm_per_px = 1, .middle_m = dem::Vector::Zero()};
  const Truth truth = truth_of(scene, camera, {400, 300}, Shown::mesh);
  EXPECT_EQ(truth.mm_per_px, 1);
  EXPECT_FALSE(truth.ground);
  EXPECT_EQ(truth.outline.size(), 200U);
  for (const vision::Point& point : truth.outline) {
    const double x = point.x - 200;
    const double slope = std::abs(x) / std::sqrt(1e4 - x * x);
    EXPECT_NEAR(point.y, 150 - std::sqrt(1e4 - x * x), .02 * (1 + slope)) << x;
  }
}

TEST(Truth, AHeapsOutlineIsTheHighestOfItsGrains) {
  const Scene heap = nut_heap(9, .6, 6);
  const PictureSize size{300, 200};
  PerspectiveCamera lens = camera_on({.distance_m = .5}, heap, size);
  const OrthographicCamera parallel = fitted_all_around({}, heap, size);
  PerspectiveCamera bent = lens;
  bent.k1 = -.15;
  lens.roll_rad = .3;
  for (const Camera& camera : {Camera(parallel), Camera(lens), Camera(bent)}) {
    std::vector<double> highest(300, 1e9);
    for (const PlacedGrain& grain : heap.grains) {
      const Scene alone{.shapes = heap.shapes, .grains = {grain}, .walls = {}};
      for (const vision::Point& point : truth_of(alone, camera, size, Shown::mesh).outline) {
        double& top = highest[static_cast<std::size_t>(point.x)];
        top = std::min(top, point.y);
      }
    }
    for (const vision::Point& point : truth_of(heap, camera, size, Shown::mesh).outline) {
      EXPECT_EQ(point.y, highest[static_cast<std::size_t>(point.x)]) << point.x;
    }
  }
}

TEST(Truth, TheGroundIsThePlatesUpperFace) {
  Scene scene = sphere_scene(.05, {{0, 0, .05}});
  scene.walls.push_back(repose::testing::plate(.3));
  const OrthographicCamera level{.mm_per_px = 1, .middle_m = dem::Vector::Zero()};
  const auto ground = truth_of(scene, level, {400, 300}, Shown::mesh).ground;
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->from.x, 0, 1e-6);
  EXPECT_NEAR(ground->to.x, 400, 1e-6);
  EXPECT_NEAR(ground->from.y, 150, 1e-6);

  PerspectiveCamera lens{.position_m = {0, -2, .1}, .roll_rad = .1, .focal_mm = 36};
  const Truth rolled = truth_of(scene, lens, {400, 300}, Shown::mesh);
  EXPECT_NEAR(rolled.mm_per_px, 5, 1e-9);
  ASSERT_TRUE(rolled.ground);
  const double slope =
      (rolled.ground->to.y - rolled.ground->from.y) / (rolled.ground->to.x - rolled.ground->from.x);
  EXPECT_NEAR(std::atan(slope), .1, 1e-9);  // > 0: the right end is lower
}

TEST(Truth, AnInclineIsNoGround) {
  Scene scene = sphere_scene(.05, {{0, 0, .2}});
  const dem::Quaternion tilt(Eigen::AngleAxisd(.3, dem::Vector::UnitY()));
  scene.walls.push_back({.shape = dem::Plane{}, .pose = {.orientation = tilt}});
  EXPECT_FALSE(truth_of(scene, OrthographicCamera{}, {40, 30}, Shown::mesh).ground);
}

}  // namespace
}  // namespace repose::render
