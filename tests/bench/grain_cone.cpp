#include "tests/bench/grain_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/nut_heap.h"

namespace repose::bench {
namespace {

using testing::kNutWidth_m;
using testing::Random;

constexpr double kSpacing = .92;   // between neighbours / width
constexpr double kLayer = .75;     // from one layer down to the next / width
constexpr int kLayers = 5;         // so that no line of sight meets the plate below
constexpr double kDeepest = .4;    // how far a grain may lie below its layer / width
constexpr double kSideways = .15;  // how far it may be shifted sideways / width

double peak_m(const GrainCone& cone) { return cone.grains_high * kNutWidth_m; }

/// A cone with a rounded tip: a hyperbola with the cone's sides as asymptotes, made concave.
double top_m(const GrainCone& cone, double r_m) {
  const double slope = std::tan(cone.angle_rad);
  const double lack_m = cone.crest * peak_m(cone);
  const double straight_m = peak_m(cone) + lack_m - std::hypot(slope * r_m, lack_m);
  if (cone.hollow == 1) return straight_m;
  return peak_m(cone) * std::pow(std::max(0.0, straight_m / peak_m(cone)), cone.hollow);
}

/// The heap's radius in a direction / its mean radius.
class Reach {
 public:
  Reach(double lopsided, Random& random)
      : lopsided_(lopsided),
        to_rad_(random.uniform(0, 2 * std::numbers::pi)),
        oval_rad_(random.uniform(0, 2 * std::numbers::pi)) {}
  double operator()(double azimuth_rad) const {
    return 1 + lopsided_ *
                   (std::cos(azimuth_rad - to_rad_) + .5 * std::cos(2 * (azimuth_rad - oval_rad_)));
  }

 private:
  double lopsided_;
  double to_rad_;
  double oval_rad_;
};

/// Grains on the ground lie flat, so that none penetrates the plate.
dem::Quaternion flat(Random& random) {
  const Eigen::AngleAxisd yaw(random.uniform(0, 2 * std::numbers::pi), dem::Vector::UnitZ());
  const Eigen::AngleAxisd roll(random.uniform(0, 2 * std::numbers::pi), dem::Vector::UnitX());
  return dem::Quaternion(yaw * roll);
}

void add_ring(render::Scene& scene, const GrainCone& cone, const Reach& reach, double r_m,
              double depth_m, Random& random) {
  const double spacing_m = kSpacing * kNutWidth_m;
  const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * r_m / spacing_m));
  const double start_rad = random.uniform(0, 2 * std::numbers::pi);
  const double lowest_m = .5 * kNutWidth_m;
  for (int i = 0; i < count; ++i) {
    const double azimuth_rad = start_rad + 2 * std::numbers::pi * i / count;
    const double far_m = r_m * reach(azimuth_rad);
    const double aside_m = kSideways * kNutWidth_m * random.uniform(-1, 1);
    const double away_m = kSideways * kNutWidth_m * random.uniform(-1, 1);
    const double deeper_m = depth_m + kDeepest * kNutWidth_m * random.uniform(0, 1);
    dem::Vector place(far_m * std::cos(azimuth_rad) + aside_m,
                      far_m * std::sin(azimuth_rad) + away_m,
                      top_m(cone, r_m) - lowest_m - deeper_m);
    const bool is_down = place.z() < lowest_m + .25 * kNutWidth_m;
    if (place.z() < 0) continue;
    if (is_down) place.z() = lowest_m;
    scene.grains.push_back(
        {.number = static_cast<int>(scene.grains.size()),
         .pose = {.position = place,
                  .orientation = is_down ? flat(random) : testing::any_orientation(random)}});
  }
}

}  // namespace

double base_radius_m(const GrainCone& cone) {
  const double lack_m = cone.crest * peak_m(cone);
  const double uncut_m = peak_m(cone) + lack_m;
  return std::sqrt(uncut_m * uncut_m - lack_m * lack_m) / std::tan(cone.angle_rad);
}

render::Scene scene_of(const GrainCone& cone) {
  render::Scene scene{.shapes = {testing::nut()}, .grains = {}, .walls = {}};
  Random random(cone.seed);
  const Reach reach(cone.lopsided, random);
  const double radius_m = base_radius_m(cone);
  const double step_m = kSpacing * kNutWidth_m * std::cos(cone.angle_rad);
  for (int layer = 0; layer < kLayers; ++layer) {
    const double depth_m = kLayer * kNutWidth_m * layer;
    for (double r_m = (layer % 2) * .5 * step_m; r_m < radius_m; r_m += step_m) {
      add_ring(scene, cone, reach, r_m, depth_m, random);
    }
  }
  scene.walls.push_back(testing::plate(3.2 * radius_m));
  return scene;
}

}  // namespace repose::bench
