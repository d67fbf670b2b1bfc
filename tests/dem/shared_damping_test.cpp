#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "dem/contact/restitution.h"
#include "dem/engine/four_contacts.h"
#include "dem/engine/time_step.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr double kImpactSpeed = 1;

SimulationSetup wood_scene(const ClumpShape& shape, double restitution, DampingModel damping,
                           double sliding_friction = 0) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
  return scene_of(shape, wood, wood,
                  {.restitution = restitution, .sliding_friction = sliding_friction},
                  RollingModel::none, damping);
}

/// Rebound speed over impact speed of a block that lands flat on the spheres in its lower corners.
double rebound_of_block(double restitution, DampingModel damping, double step, double late) {
  SimulationSetup setup = wood_scene(block_shape({.02, .02, .01}, .005), restitution, damping);
  setup.walls = {tilted_plane(0)};
  setup.timestep_s = accurate_timestep_s(setup, kImpactSpeed, step);
  Simulation simulation(setup);
  simulation.add({.position = {0, 0, .01 + late * setup.timestep_s * kImpactSpeed},
                  .velocity = {0, 0, -kImpactSpeed}});
  return collide(simulation, .005).after.velocity.z() / kImpactSpeed;
}

// As accurate as a single contact, at the time steps of all experiments.
TEST(SharedDamping, FourContactsAtOnceRestoreWhatOneDoes) {
  for (const auto& [step, tolerance] : {std::pair{.07, .0015}, {.14, .004}, {.30, .02}}) {
    for (const double e : {.05, .2, .5, .8, 1.0}) {
      for (const double late : {0.0, .4, .8}) {
        EXPECT_NEAR(rebound_of_block(e, DampingModel::shared, step, late), e, tolerance)
            << step << ", " << late;
      }
    }
  }
  EXPECT_NEAR(rebound_of_block(.5, DampingModel::per_contact, .07, 0),
              restitution_of(2 * damping_factor(.5)), .0015);
}

/// Two spheres side by side along y.
ClumpShape dumbbell() {
  ClumpShape shape;
  for (const double side : {-1.0, 1.0}) {
    shape.spheres.push_back({.centre = {0, side * .006, 0}, .radius = .005});
  }
  shape.volume_m3 = 1e-6;
  shape.gyration_m2 = {3e-5, 1e-5, 3e-5};
  return shape;
}

/// A right-angled groove along y, made of one wall.
Wall groove() {
  Wall mesh;
  mesh.material = 1;
  mesh.shape = MeshSurface{
      {.vertices = {{-1, -1, 1}, {-1, 1, 1}, {0, -1, 0}, {0, 1, 0}, {1, -1, 1}, {1, 1, 1}},
       .triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}}};
  return mesh;
}

/// Rebound speed over impact speed of a dumbbell that falls into a groove.
double rebound_in_groove(const std::vector<Wall>& walls, DampingModel damping) {
  SimulationSetup setup = wood_scene(dumbbell(), .4, damping);
  setup.walls = walls;
  setup.timestep_s = .5 * accurate_timestep_s(setup, kImpactSpeed);
  Simulation simulation(setup);
  simulation.add({.position = {0, 0, .005 * std::sqrt(2.0)}, .velocity = {0, 0, -kImpactSpeed}});
  return collide(simulation, .005).after.velocity.z() / kImpactSpeed;
}

// Each flank of the groove takes its half of the impact as if the other did not exist.
TEST(SharedDamping, ContactsAcrossEachOtherDoNotShare) {
  const double slope = std::acos(-1.0) / 4;
  const std::vector<Wall> planes = {tilted_plane(slope), tilted_plane(-slope)};
  EXPECT_NEAR(rebound_in_groove(planes, DampingModel::shared), .4, .002);
  EXPECT_NEAR(rebound_in_groove({groove()}, DampingModel::shared), .4, .002);
  EXPECT_NEAR(rebound_in_groove(planes, DampingModel::per_contact),
              restitution_of(std::sqrt(2) * damping_factor(.4)), .002);
}

/// Velocity of a ball falling onto a wall, while it touches the wall in several places.
Vector velocity_of_ball(const Wall& wall, DampingModel damping) {
  SimulationSetup setup = wood_scene(sphere_shape(.005), .4, damping, .4);
  setup.walls = {wall};
  setup.timestep_s = accurate_timestep_s(setup, kImpactSpeed);
  Simulation simulation(setup);
  simulation.add({.position = {1e-5, 0, .00708}, .velocity = {0, 0, -kImpactSpeed}});
  while (simulation.contacts().size() < 2) simulation.advance(1);
  simulation.advance(5);
  EXPECT_GE(simulation.contacts().size(), 2U);
  return simulation.grain(0).velocity;
}

// A single sphere in a groove, or in the hollow of glued grains, is damped as before.
TEST(SharedDamping, GrainOfOneSphereIsTheSameToTheByteAsPerContact) {
  Wall hollow;
  hollow.material = 1;
  SphereBed bed;
  for (const double x : {-.0045, .0045}) {
    for (const double y : {-.0045, .0045}) {
      bed.spheres.push_back({.centre = {x, y, 0}, .radius = .004});
    }
  }
  bed.tile = .03;
  hollow.shape = bed;
  for (const Wall& wall : {groove(), hollow}) {
    EXPECT_EQ(velocity_of_ball(wall, DampingModel::shared),
              velocity_of_ball(wall, DampingModel::per_contact));
  }
}

// Blocks that strike a wall or each other in any pose: friction and dampers only dissipate.
TEST(SharedDamping, NoImpactMakesEnergyOrPulls) {
  for (const bool on_block : {false, true}) {
    for (int k = 0; k < 20; ++k) {
      SimulationSetup setup =
          wood_scene(block_shape({.02, .015, .01}, .005), .3, DampingModel::shared, .4);
      if (!on_block) setup.walls = {tilted_plane(0)};
      setup.timestep_s = accurate_timestep_s(setup, 2 * kImpactSpeed);
      Simulation simulation(setup);
      const Vector turn(std::sin(k), std::sin(2.1 * k), std::sin(3.3 * k));
      Grain block;
      block.position.z() = .03;
      block.orientation = Eigen::AngleAxisd(.7 * k, turn.normalized());
      block.velocity = {.5, 0, -kImpactSpeed};
      block.spin = 10 * turn;
      simulation.add(block);
      if (on_block) simulation.add({.position = {0, 0, -.028}});
      double least = simulation.energies().sum_j();
      double pull = 0;
      const auto steps = static_cast<int>(.08 / setup.timestep_s);
      for (int step = 0; step < steps; ++step) {
        simulation.advance(1);
        const double energy = simulation.energies().sum_j();
        EXPECT_LT(energy, least * 1.001) << k;
        least = std::min(least, energy);
        if (!on_block) pull = std::min(pull, simulation.force_n(0).z());
      }
      EXPECT_LT(least, .95 * simulation.mass_kg(0) * kImpactSpeed * kImpactSpeed) << "they struck";
      EXPECT_EQ(pull, 0);
    }
  }
}

}  // namespace
}  // namespace repose::dem
