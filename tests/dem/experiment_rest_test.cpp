#include <optional>

#include <gtest/gtest.h>

#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

constexpr double kRestingRadius_m = 5e-3;

/// A soft ball lying on a plate and spinning.
Simulation spinning_ball(RollingModel rolling, const Vector& spin) {
  Model model = test::soft_bench();
  model.grain = sphere_shape(kRestingRadius_m);
  model.rolling = rolling;
  Simulation simulation(model_setup(model, model.grain, {study_wall(Plane{})}, .1, kBulkFraction));
  simulation.add({.position = {0, 0, kRestingRadius_m}, .spin = spin});
  return simulation;
}

/// The time at which it is at rest, s.
std::optional<double> rest_s(Simulation& simulation, double longest_s) {
  RestTest rest(simulation.setup());
  const auto steps = static_cast<int>(rest.interval_s() / simulation.setup().timestep_s) + 1;
  while (simulation.time_s() < longest_s) {
    simulation.advance(steps);
    if (rest.is_at_rest(simulation)) return simulation.time_s();
  }
  return std::nullopt;
}

TEST(RestTest, SpinOnTheSpotDoesNotCountWhereNothingResistsIt) {
  for (const RollingModel rolling : {RollingModel::none, RollingModel::relative_constant_torque,
                                     RollingModel::elastic_plastic}) {
    Simulation simulation = spinning_ball(rolling, {0, 0, 20});
    EXPECT_TRUE(rest_s(simulation, 1)) << static_cast<int>(rolling);
    EXPECT_NEAR(simulation.grain(0).spin.z(), 20, .1) << "it spins for ever";
    EXPECT_LT(simulation.grain(0).position.head<2>().norm(), 1e-6);
  }
}

/// As in the apron of a heap: nor if it barely touches its neighbour.
TEST(RestTest, SpinOnTheSpotDoesNotCountForGrazingANeighbour) {
  Simulation simulation = spinning_ball(RollingModel::relative_constant_torque, {0, 0, 20});
  const double apart_m = 2 * kRestingRadius_m - 1e-9;
  simulation.add({.position = {apart_m, 0, kRestingRadius_m}});
  EXPECT_TRUE(rest_s(simulation, .3));
  EXPECT_GT(simulation.grain(0).spin.z(), 10);
  EXPECT_EQ(simulation.contacts().size(), 3U) << "two on the plate, and the graze";
}

TEST(RestTest, SpinThatATorqueResistsIsWaitedFor) {
  Simulation simulation = spinning_ball(RollingModel::constant_torque, {0, 0, 20});
  EXPECT_TRUE(rest_s(simulation, 2));
  EXPECT_EQ(simulation.grain(0).spin.norm(), 0);
}

TEST(RestTest, SpinThatMovesAGrainShowsInItsVelocity) {
  for (const RollingModel rolling :
       {RollingModel::relative_constant_torque, RollingModel::elastic_plastic}) {
    Simulation simulation = spinning_ball(rolling, {0, 20, 20});
    EXPECT_TRUE(rest_s(simulation, 2)) << static_cast<int>(rolling);
    // 2/7 of the spin goes into rolling, which is decelerated by mu_r g 5/7.
    EXPECT_GT(simulation.grain(0).position.x(), 1e-4);
    EXPECT_LT(simulation.grain(0).velocity.norm(), 1e-3);
  }
}

/// With laws that resist rolling, heaps come to rest and remain so.
TEST(RestTest, HeapOfRelativeConstantTorqueRestsForGood) {
  Model model = test::soft_bench();
  model.grain = sphere_shape(kRestingRadius_m);
  model.rolling = RollingModel::relative_constant_torque;
  model.grain_wall = model.grain_grain = {.5, .5, .5};
  const HeapProtocol protocol = {
      .tube_diameter_m = .05, .tube_height_m = .12, .plate_m = .3, .grains = 40};
  const Repeat heap = run_heap(model, protocol, 1);
  EXPECT_EQ(heap.readings.at("at_rest"), 1);
  EXPECT_GT(heap.readings.at("height_mm"), 4e3 * kRestingRadius_m) << "no layer";
  Simulation later(heap.state->setup(), heap.state->checkpoint());
  while (later.time_s() < heap.state->time_s() + .2) later.advance(100);
  for (int k = 0; k < later.grain_count(); ++k) {
    EXPECT_LT((later.grain(k).position - heap.state->grain(k).position).norm(), 1e-6) << k;
  }
}

}  // namespace
}  // namespace repose::dem
