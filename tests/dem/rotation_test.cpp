#include <cmath>

#include <gtest/gtest.h>

#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

const Material kWood{
    .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};

Simulation spinning(const ClumpShape& shape, const Vector& spin, double timestep) {
  SimulationSetup setup = scene_of(shape, kWood, kWood, {});
  setup.timestep_s = timestep;
  Simulation simulation(std::move(setup));
  Grain grain;
  grain.spin = spin;
  simulation.add(grain);
  return simulation;
}

const ClumpShape kBlock = block_shape({.03, .02, .01}, .005);
const Vector kMiddleSpin(.5, 50, .3);

TEST(FreeRotation, SphereTurnsByItsSpin) {
  Simulation simulation = spinning(sphere_shape(.01), {0, 0, 3}, 1e-4);
  simulation.advance(10000);
  const Eigen::AngleAxisd turned(simulation.grain(0).orientation);
  EXPECT_NEAR(turned.angle(), 3, 1e-6);
  EXPECT_NEAR(turned.axis().z(), 1, 1e-12);
}

TEST(FreeRotation, SpinAboutTheLargestMomentStays) {
  Simulation simulation = spinning(kBlock, {0, 0, 40}, 1e-4);
  simulation.advance(10000);
  EXPECT_NEAR((simulation.grain(0).spin - Vector(0, 0, 40)).norm(), 0, 1e-9);
}

TEST(FreeRotation, AngularMomentumIsKept) {
  Simulation simulation = spinning(kBlock, kMiddleSpin, 1e-4);
  const Vector before = simulation.checkpoint().angular_momentum[0];
  simulation.advance(20000);
  EXPECT_EQ(simulation.checkpoint().angular_momentum[0], before);
}

double energy_error(double timestep) {
  Simulation simulation = spinning(kBlock, kMiddleSpin, timestep);
  const double before = simulation.energies().kinetic_j;
  double worst = 0;
  while (simulation.time_s() < 2) {
    simulation.advance(1);
    worst = std::max(worst, std::abs(simulation.energies().kinetic_j / before - 1));
  }
  return worst;
}

TEST(FreeRotation, EnergyErrorFallsWithTheSquareOfTheTimestep) {
  const double coarse = energy_error(4e-4);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / energy_error(2e-4), 4, .4);
}

TEST(FreeRotation, OrientationStaysAUnitQuaternion) {
  Simulation simulation = spinning(kBlock, kMiddleSpin, 1e-3);
  simulation.advance(10000);
  EXPECT_NEAR(simulation.grain(0).orientation.norm(), 1, 1e-15);
}

TEST(FreeRotation, SpinGivenIsSpinRead) {
  SimulationSetup setup = scene_of(kBlock, kWood, kWood, {});
  setup.timestep_s = 1e-4;
  Simulation simulation(setup);
  Grain grain;
  grain.orientation = Eigen::AngleAxisd(1.2, Vector(1, 2, 3).normalized());
  grain.spin = kMiddleSpin;
  simulation.add(grain);
  EXPECT_NEAR((simulation.grain(0).spin - kMiddleSpin).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace repose::dem
