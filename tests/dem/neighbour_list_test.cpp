#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "dem/engine/unstable_run.h"
#include "dem/wall/wall_set.h"
#include "tests/dem/packing.h"

namespace repose::dem {
namespace {

/// Grain, sphere, other grain (or -1 - wall), its sphere (or facet).
using TouchingSet = std::set<std::tuple<int, int, int, int>>;

TouchingSet listed(const Simulation& simulation) {
  TouchingSet all;
  for (const ContactState& contact : simulation.contacts()) {
    all.insert({contact.grain_a, contact.sphere_a, contact.grain_b, contact.sphere_b});
  }
  return all;
}

const std::vector<ClumpSphere>& spheres_of(const Simulation& simulation, int grain) {
  const auto kind = static_cast<std::size_t>(simulation.grain(grain).kind);
  return simulation.setup().kinds[kind].shape.spheres;
}

Vector centre_of(const Simulation& simulation, int grain, int sphere) {
  const Grain now = simulation.grain(grain);
  return now.position +
         now.orientation * spheres_of(simulation, grain)[static_cast<std::size_t>(sphere)].centre;
}

/// Calls visit(grain, sphere, centre, radius).
template <typename Visit>
void for_each_sphere(const Simulation& simulation, const Visit& visit) {
  for (int grain = 0; grain < simulation.grain_count(); ++grain) {
    if (!simulation.is_present(grain)) continue;
    const auto& spheres = spheres_of(simulation, grain);
    for (int s = 0; s < static_cast<int>(spheres.size()); ++s) {
      visit(grain, s, centre_of(simulation, grain, s), spheres[static_cast<std::size_t>(s)].radius);
    }
  }
}

/// Compares every sphere with all others and with every wall.
TouchingSet brute_force(const Simulation& simulation) {
  TouchingSet all;
  WallSet walls(simulation.setup().walls);
  walls.move_to(simulation.time_s());
  for_each_sphere(simulation, [&](int a, int sphere_a, const Vector& centre_a, double radius_a) {
    for_each_sphere(simulation, [&](int b, int sphere_b, const Vector& centre_b, double radius_b) {
      if (b > a && (centre_b - centre_a).norm() < radius_a + radius_b) {
        all.insert({a, sphere_a, b, sphere_b});
      }
    });
    for (int wall = 0; wall < walls.size(); ++wall) {
      if (walls.contact(wall, 0, centre_a).distance < radius_a) {
        all.insert({a, sphere_a, -1 - wall, 0});
      }
    }
  });
  return all;
}

TEST(NeighbourList, EveryTouchingPairIsFoundWhileGrainsFallAndSettle) {
  Simulation simulation = loose_packing(packing_setup(), 20);
  std::size_t most = 0;
  for (int k = 0; k < 150; ++k) {
    simulation.advance(97);
    const TouchingSet expected = brute_force(simulation);
    EXPECT_EQ(listed(simulation), expected) << "step " << simulation.step();
    most = std::max(most, expected.size());
  }
  EXPECT_GT(most, 40U);
}

TEST(NeighbourList, EveryTouchingPairIsFoundInOverlappingHeaps) {
  for (int seed = 0; seed < 20; ++seed) {
    SimulationSetup setup = packing_setup();
    setup.walls.clear();
    setup.timestep_s = 1e-12;  // nothing moves
    Simulation simulation(std::move(setup));
    for (int k = 0; k < 40; ++k) {
      Grain grain = loose_grain(k + 100 * seed);
      grain.position = .05 * Vector(std::sin(12.9898 * k + seed), std::sin(78.233 * k - seed),
                                    std::sin(37.719 * k + 2 * seed));
      simulation.add(grain);
    }
    EXPECT_THROW(simulation.advance(1), UnstableRun);  // no real run has overlaps like these
    const TouchingSet expected = brute_force(simulation);
    EXPECT_EQ(listed(simulation), expected);
    EXPECT_GT(expected.size(), 20U);
  }
}

TEST(NeighbourList, StrayGrainsFarAwayDoNotHideContacts) {
  Simulation simulation = loose_packing(packing_setup(), 12);
  Grain stray = loose_grain(3);
  stray.position = {1e4, -3e4, 2e4};
  simulation.add(stray);
  for (int k = 0; k < 20; ++k) {
    simulation.advance(400);
    EXPECT_EQ(listed(simulation), brute_force(simulation));
  }
}

TEST(NeighbourList, FastWallIsNotMissed) {
  SimulationSetup setup = packing_setup();
  setup.gravity.setZero();
  Wall ram;
  ram.shape = Box{.half_size = {.02, .02, .005}};
  ram.material = 1;
  ram.pose.position.z() = .5;
  ram.motions = {{.velocity = {0, 0, -3}}};
  setup.walls = {ram};
  Simulation simulation = loose_packing(setup, 6);
  bool struck = false;
  for (int k = 0; k < 800; ++k) {
    simulation.advance(10);
    const TouchingSet expected = brute_force(simulation);
    ASSERT_EQ(listed(simulation), expected) << "step " << simulation.step();
    struck = struck || !expected.empty();
  }
  EXPECT_TRUE(struck);
}

TEST(NeighbourList, ResultsDoNotShowWhenItWasMade) {
  Simulation seldom = loose_packing(packing_setup(), 12);
  Simulation often = loose_packing(packing_setup(), 12);
  for (int k = 0; k < 4000; ++k) {
    seldom.advance(1);
    often.advance(1);
    if (k % 3 == 0) often.set_motions(0, {});  // the list is rebuilt
  }
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(seldom.grain(k).position, often.grain(k).position) << k;
    EXPECT_EQ(seldom.grain(k).spin, often.grain(k).spin) << k;
  }
}

}  // namespace
}  // namespace repose::dem
