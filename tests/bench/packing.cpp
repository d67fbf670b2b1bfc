#include "tests/bench/packing.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "base/units.h"

namespace repose::testing {
namespace {

using dem::Vector;

constexpr double kTimestep_s = 2e-5;
constexpr double kTubeRadius_m = .05;
constexpr double kHalfLength_m = .01124;
constexpr double kHalfWidth_m = .00892;
constexpr int kClumpSpheres = 11;
constexpr int kTiles = 9;

/// Uniform in -1/2 ... 1/2, the same on every machine.
double uniform(std::mt19937& random) {
  return (static_cast<double>(random()) + .5) / 4294967296.0 - .5;
}

dem::SimulationSetup setup_of(const dem::ClumpShape& shape, std::vector<dem::Wall> walls,
                              int threads) {
  const dem::Material nut{
      .name = "nut", .density_kg_m3 = 851, .young_modulus_pa = 1.254e7, .poisson_ratio = .38};
  const dem::Material steel{
      .name = "steel", .density_kg_m3 = 7850, .young_modulus_pa = 2.1e9, .poisson_ratio = .3};
  const dem::PairCoefficients on_nut{.11, .21, .04};
  const dem::PairCoefficients on_steel{.31, .39, .04};
  for (dem::Wall& wall : walls) wall.material = 1;
  return {.kinds = {{shape, 0}},
          .walls = std::move(walls),
          .contacts = dem::ContactTable({nut, steel}, {on_nut, on_steel, on_steel, on_steel},
                                        dem::RollingModel::constant_torque),
          .timestep_s = kTimestep_s,
          .threads = threads};
}

/// Fills layers of a grid wherever `is_inside` allows, and lets the grains fall.
template <typename Inside>
dem::Simulation poured(const dem::SimulationSetup& setup, int grains, double spacing, double reach,
                       const Inside& is_inside) {
  dem::Simulation simulation(setup);
  std::mt19937 random(1);
  const int cells = static_cast<int>(reach / spacing) + 1;
  int placed = 0;
  for (int layer = 0; placed < grains; ++layer) {
    for (int i = -cells; i <= cells && placed < grains; ++i) {
      for (int j = -cells; j <= cells && placed < grains; ++j) {
        const Vector at(i * spacing, j * spacing, (layer + .5) * spacing);
        if (!is_inside(at)) continue;
        dem::Quaternion pose(uniform(random), uniform(random), uniform(random), uniform(random));
        simulation.add({.position = at,
                        .orientation = pose.normalized(),
                        .velocity = {.1 * uniform(random), .1 * uniform(random), -.5}});
        ++placed;
      }
    }
  }
  const double height = std::ceil(grains * std::pow(spacing / reach, 2) / 3) * spacing;
  const double fall_s = std::sqrt(2 * height / kStandardGravity_m_s2);
  simulation.advance(static_cast<std::int64_t>((fall_s + .3) / kTimestep_s));
  return simulation;
}

dem::Wall side(const Vector& position, const Vector& inwards) {
  dem::Wall wall;  // a plane
  wall.pose.position = position;
  wall.pose.orientation = dem::Quaternion::FromTwoVectors(Vector::UnitZ(), inwards);
  return wall;
}

dem::Simulation box_of(const dem::ClumpShape& shape, int grains, int threads) {
  const double reach = shape.reach_m();
  // As deep as wide, once settled.
  const double half = 1.13 * std::cbrt(grains * shape.volume_m3 * 3 / (4 * std::numbers::pi));
  const std::vector<dem::Wall> walls = {
      side({0, 0, 0}, {0, 0, 1}), side({-half, 0, 0}, {1, 0, 0}), side({half, 0, 0}, {-1, 0, 0}),
      side({0, -half, 0}, {0, 1, 0}), side({0, half, 0}, {0, -1, 0})};
  const double room = half - 1.02 * reach;
  return poured(
      setup_of(shape, walls, threads), grains, 2.06 * reach, half,
      [room](const Vector& at) { return std::max(std::abs(at.x()), std::abs(at.y())) <= room; });
}

/// The mirror image of a grain with rotational symmetry about its x axis, across x = x_m, y = y_m
/// or both.
dem::Grain mirrored(const dem::Grain& grain, std::optional<double> x_m, std::optional<double> y_m) {
  Vector at = grain.position;
  Vector axis = grain.orientation * Vector::UnitX();
  if (x_m) at.x() = 2 * *x_m - at.x();
  if (x_m) axis.x() = -axis.x();
  if (y_m) at.y() = 2 * *y_m - at.y();
  if (y_m) axis.y() = -axis.y();
  return {.position = at, .orientation = dem::Quaternion::FromTwoVectors(Vector::UnitX(), axis)};
}

dem::Simulation mirrored(const dem::Simulation& tile) {
  dem::SimulationSetup setup = tile.setup();
  const double half = std::abs(setup.walls.back().pose.position.y());
  for (dem::Wall& wall : setup.walls) wall.pose.position *= 3;
  dem::Simulation simulation(setup);
  const auto mirror = [half](int i) { return i == 0 ? std::nullopt : std::optional(i * half); };
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      for (int k = 0; k < tile.grain_count(); ++k) {
        simulation.add(mirrored(tile.grain(k), mirror(i), mirror(j)));
      }
    }
  }
  return simulation;
}

}  // namespace

dem::ClumpShape spheroid_nut(int spheres) {
  const double a2 = kHalfLength_m * kHalfLength_m;
  const double b2 = kHalfWidth_m * kHalfWidth_m;
  const double volume = 4.0 / 3 * std::numbers::pi * kHalfLength_m * b2;
  if (spheres == 1) return dem::sphere_shape(std::cbrt(kHalfLength_m * b2));
  dem::ClumpShape shape;
  const double last = kHalfLength_m - b2 / kHalfLength_m;  // its sphere fits the tip
  for (int k = 0; k < spheres; ++k) {
    const double x = last * (2.0 * k / (spheres - 1) - 1);
    shape.spheres.push_back(
        {.centre = {x, 0, 0}, .radius = std::sqrt(b2 * (1 - x * x / (a2 - b2)))});
  }
  shape.volume_m3 = volume;
  shape.gyration_m2 = {2 * b2 / 5, (a2 + b2) / 5, (a2 + b2) / 5};
  return shape;
}

dem::SimulationSetup tube_setup(int threads) {
  const dem::Wall floor;  // a plane
  dem::Wall tube;
  tube.shape = dem::Tube{kTubeRadius_m, .002, 100};
  return setup_of(spheroid_nut(kClumpSpheres), {floor, tube}, threads);
}

dem::Simulation tube_of_clumps(int grains, int threads) {
  const double room = kTubeRadius_m - 1.02 * kHalfLength_m;
  return poured(tube_setup(threads), grains, 2.1 * kHalfLength_m, kTubeRadius_m,
                [room](const Vector& at) { return std::hypot(at.x(), at.y()) <= room; });
}

dem::Simulation box_of_spheres(int grains, int threads) {
  return box_of(spheroid_nut(1), grains, threads);
}

dem::Simulation box_of_clumps(int grains, int threads) {
  return box_of(spheroid_nut(kClumpSpheres), grains, threads);
}

dem::Simulation wide_box_of_spheres(int grains, int threads) {
  return mirrored(box_of_spheres((grains + kTiles - 1) / kTiles, threads));
}

dem::Simulation wide_box_of_clumps(int grains, int threads) {
  return mirrored(box_of_clumps((grains + kTiles - 1) / kTiles, threads));
}

}  // namespace repose::testing
