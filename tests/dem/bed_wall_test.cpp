
#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/engine/simulation.h"
#include "dem/wall/facets.h"
#include "tests/support/error_of.h"

namespace repose::dem {
namespace {

constexpr double kRadius_m = .003;

SphereBed bed_of(const std::vector<Vector>& centres) {
  SphereBed bed{.spheres = {}, .tile = .05};
  for (const Vector& centre : centres) bed.spheres.push_back({centre, kRadius_m});
  return bed;
}

std::vector<int> near(const SphereBed& bed, const Vector& point, double distance) {
  std::vector<int> facets;
  BedFacets(bed).near(point, distance, facets);
  return facets;
}

TEST(BedWall, RepeatsItselfWithoutEnd) {
  const SphereBed bed = bed_of({{.001, .002, 0}, {.02, .03, 0}});
  for (const double shift : {0.0, .05, -.15, 5.0}) {
    const Vector above(.001 + shift, .002 - 2 * shift, 2 * kRadius_m);
    EXPECT_EQ(near(bed, above, 1.01 * kRadius_m), std::vector<int>{0}) << shift;
    const Closest spot = BedFacets(bed).closest(0, above);
    EXPECT_NEAR(spot.distance, kRadius_m, 1e-12) << shift;
    EXPECT_NEAR(spot.normal.z(), 1, 1e-9) << shift;
  }
}

TEST(BedWall, FindsSpheresAcrossTheTilesEdge) {
  const SphereBed bed = bed_of({{.0001, .0001, 0}, {.0499, .0499, 0}});
  EXPECT_EQ(near(bed, {.05, 0, 0}, .01), (std::vector<int>{0, 1}));
}

TEST(BedWall, EndsWhereItIsTold) {
  SphereBed bed = bed_of({{.001, .002, 0}});
  bed.from_x = 0;
  EXPECT_EQ(near(bed, {.001, .002, 2 * kRadius_m}, .01).size(), 1U);
  EXPECT_EQ(near(bed, {-.049, .002, 2 * kRadius_m}, .01).size(), 0U) << "an image beyond the end";
}

TEST(BedWall, RefusesSpheresTooWideForItsTile) {
  SphereBed bed = bed_of({{0, 0, 0}, {.01, 0, 0}});
  bed.tile = 3 * kRadius_m;
  EXPECT_NE(error_of([&] { BedFacets{bed}; }).find("less than a quarter"), std::string::npos);
  EXPECT_THROW(BedFacets{bed_of({})}, base::InputError);
}

/// A ball after striking another one obliquely.
Grain struck(bool is_bed) {
  const Material glass{"glass", 2500, 1e8, .25};
  const Material heavy{"heavy glass", 2500e9, 1e8, .25};
  const PairCoefficients pair{.6, .3, .05};
  SimulationSetup setup{.kinds = {{sphere_shape(kRadius_m), 0}, {sphere_shape(kRadius_m), 1}},
                        .walls = {},
                        .contacts = ContactTable({glass, heavy}, {pair, pair, pair, pair},
                                                 RollingModel::relative_constant_torque),
                        .gravity = Vector::Zero(),
                        .timestep_s = 1e-6};
  if (is_bed) {
    Wall bed;
    bed.shape = bed_of({Vector::Zero()});
    bed.material = 1;
    setup.walls = {bed};
  }
  Simulation simulation(setup);
  simulation.add({.position = {.002, 0, .006}, .velocity = {0, 0, -.5}, .spin = {10, 50, 30}});
  if (!is_bed) simulation.add({.kind = 1});
  simulation.advance(4000);
  return simulation.grain(0);
}

TEST(BedWall, ActsAsABallWithoutEndOfMass) {
  const Grain wall = struck(true);
  const Grain pair = struck(false);
  EXPECT_GT(wall.velocity.norm(), .1) << "it has bounced off";
  EXPECT_NEAR((wall.velocity - pair.velocity).norm(), 0, 1e-6);
  EXPECT_NEAR((wall.spin - pair.spin).norm(), 0, 1e-3);
}

}  // namespace
}  // namespace repose::dem
