#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "tests/dem/packing.h"
#include "tests/support/error_of.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kGrains = 16;

/// All numbers of the first `grains` grains must be bit-identical.
void expect_same(const Simulation& one, const Simulation& other, std::size_t grains) {
  const Checkpoint a = one.checkpoint();
  const Checkpoint b = other.checkpoint();
  ASSERT_EQ(a.step, b.step);
  ASSERT_LE(grains, std::min(a.grains.size(), b.grains.size()));
  for (std::size_t k = 0; k < grains; ++k) {
    EXPECT_EQ(a.grains[k].position, b.grains[k].position) << k;
    EXPECT_EQ(a.grains[k].orientation.coeffs(), b.grains[k].orientation.coeffs()) << k;
    EXPECT_EQ(a.grains[k].velocity, b.grains[k].velocity) << k;
    EXPECT_EQ(a.angular_momentum[k], b.angular_momentum[k]) << k;
    EXPECT_EQ(a.force[k], b.force[k]) << k;
    EXPECT_EQ(a.torque[k], b.torque[k]) << k;
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    EXPECT_EQ(a.contacts[k].tangential_n, b.contacts[k].tangential_n) << k;
    EXPECT_EQ(a.contacts[k].rolling_n_m, b.contacts[k].rolling_n_m) << k;
  }
}
void expect_same(const Simulation& one, const Simulation& other) {
  ASSERT_EQ(one.grain_count(), other.grain_count());
  expect_same(one, other, static_cast<std::size_t>(one.grain_count()));
}

/// Columns side by side on a wide floor, so many that each thread has some to list.
Simulation many_columns(int threads) {
  constexpr int kColumns = 24;
  SimulationSetup setup = packing_setup();
  setup.walls = {{.material = 1}};
  setup.threads = threads;
  Simulation simulation(setup);
  for (int k = 0; k < kColumns * kGrains; ++k) {
    Grain grain = loose_grain(k / kColumns);
    const int row = k % kColumns / 8;
    grain.position += Vector(.05 * (k % 8), .05 * row, 0);
    simulation.add(grain);
  }
  return simulation;
}

TEST(Bodies, SoManyThatThreadsShareTheListAreTheSameToTheByte) {
  Simulation one = many_columns(1);
  Simulation two = many_columns(2);
  one.advance(9000);
  two.advance(9000);
  EXPECT_GT(one.contacts().size(), 200U);
  expect_same(one, two);
}

class RollingModels : public ::testing::TestWithParam<RollingModel> {};

TEST_P(RollingModels, TwoThreadsGiveTheSameBytes) {
  SimulationSetup setup = packing_setup(GetParam());
  Simulation one = loose_packing(setup, kGrains);
  setup.threads = 2;
  Simulation two = loose_packing(setup, kGrains);
  one.advance(8000);
  two.advance(8000);
  EXPECT_GT(one.contacts().size(), 5U);
  expect_same(one, two);
}

TEST_P(RollingModels, BallsAreTheSameWhetherOrNotAllGrainsAreRound) {
  SimulationSetup setup = packing_setup(GetParam());
  setup.kinds.push_back({.shape = sphere_shape(.005), .material = 0});
  Simulation balls(setup);
  Simulation with_block(setup);
  for (int k = 0; k < kGrains; ++k) {
    Grain grain = loose_grain(k);
    grain.kind = 2;
    balls.add(grain);
    with_block.add(grain);
  }
  with_block.add({.kind = 0, .position = {.5, 0, 1}});  // far away
  balls.advance(12000);
  with_block.advance(12000);
  EXPECT_GT(balls.contacts().size(), 5U);
  expect_same(balls, with_block, kGrains);
}

TEST_P(RollingModels, RestartFromACheckpointContinuesBitForBit) {
  Simulation simulation = loose_packing(packing_setup(GetParam()), kGrains);
  simulation.advance(6001);
  Simulation restarted(packing_setup(GetParam()), simulation.checkpoint());
  expect_same(simulation, restarted);
  simulation.advance(3000);
  restarted.advance(3000);
  expect_same(simulation, restarted);
}

SimulationSetup shared_packing() {
  return packing_setup(RollingModel::elastic_plastic, DampingModel::shared);
}

TEST(SharedDamping, TwoThreadsGiveTheSameBytes) {
  SimulationSetup setup = shared_packing();
  Simulation one = loose_packing(setup, kGrains);
  setup.threads = 2;
  Simulation two = loose_packing(setup, kGrains);
  one.advance(8000);
  two.advance(8000);
  EXPECT_GT(one.contacts().size(), 5U);
  expect_same(one, two);
}

TEST(SharedDamping, RestartFromACheckpointContinuesBitForBit) {
  Simulation simulation = loose_packing(shared_packing(), kGrains);
  simulation.advance(6001);
  Simulation restarted(shared_packing(), simulation.checkpoint());
  simulation.advance(3000);
  restarted.advance(3000);
  expect_same(simulation, restarted);
}

TEST(SharedDamping, ElasticClumpsAreTheSameToTheByteAsPerContact) {
  SimulationSetup shared = shared_packing();
  const auto elastic = [&](DampingModel damping) {
    const PairCoefficients pair{.sliding_friction = .5};
    return ContactTable({shared.contacts.material(0), shared.contacts.material(1)},
                        {pair, pair, pair, pair}, RollingModel::none, damping);
  };
  shared.contacts = elastic(DampingModel::shared);
  SimulationSetup per_contact = shared;
  per_contact.contacts = elastic(DampingModel::per_contact);
  Simulation one = loose_packing(shared, kGrains);
  Simulation other = loose_packing(per_contact, kGrains);
  one.advance(8000);
  other.advance(8000);
  EXPECT_GT(one.contacts().size(), 2U);
  expect_same(one, other);
}

INSTANTIATE_TEST_SUITE_P(All, RollingModels,
                         ::testing::Values(RollingModel::none, RollingModel::constant_torque,
                                           RollingModel::relative_constant_torque,
                                           RollingModel::elastic_plastic));

TEST(Checkpoint, IsTakenRightAfterAGrainWasTakenOut) {
  Simulation simulation = loose_packing(packing_setup(), kGrains);
  simulation.advance(8000);
  ASSERT_FALSE(simulation.contacts().empty());
  simulation.remove(simulation.contacts().front().grain_a);
  Simulation restarted(packing_setup(), simulation.checkpoint());
  simulation.advance(100);
  restarted.advance(100);
  expect_same(simulation, restarted);
}

TEST(Checkpoint, ThatWasChangedIsRefused) {
  Simulation simulation = loose_packing(packing_setup(), kGrains);
  simulation.advance(8000);
  const Checkpoint whole = simulation.checkpoint();
  ASSERT_FALSE(whole.contacts.empty());

  Checkpoint short_of_forces = whole;
  short_of_forces.force.pop_back();
  EXPECT_THROW(Simulation(packing_setup(), short_of_forces), base::InputError);

  Checkpoint far_contact = whole;
  far_contact.grains[static_cast<std::size_t>(whole.contacts.front().grain_a)].position.z() += 1;
  EXPECT_THROW(Simulation(packing_setup(), far_contact), base::InputError);
}

TEST(Bodies, GrainsThatAreNoNumbersAreRefused) {
  Simulation simulation = loose_packing(packing_setup(), 0);
  Grain nowhere = loose_grain(0);
  nowhere.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulation.add(nowhere), base::InputError);
  Grain long_quaternion = loose_grain(0);
  long_quaternion.orientation.coeffs() *= 2;
  EXPECT_THROW(simulation.add(long_quaternion), base::InputError);
  EXPECT_EQ(simulation.grain_count(), 0);
}

TEST(Bodies, GrainsInTheAirFallAsGalileiSays) {
  Simulation simulation = loose_packing(packing_setup(), 1);
  Grain grain = loose_grain(0);
  grain.position.z() = 100;
  const int high = simulation.add(grain);
  simulation.advance(10000);
  const double time = simulation.time_s();
  EXPECT_NEAR(simulation.grain(high).position.z(),
              100 + grain.velocity.z() * time - kStandardGravity_m_s2 * time * time / 2, 1e-9);
}

TEST(Bodies, MassIsTheShapesAndNotTheSpheres) {
  Simulation simulation = loose_packing(packing_setup(), 1);
  EXPECT_NEAR(simulation.mass_kg(0), 1000 * .020 * .014 * .010, 1e-15);
}

TEST(Bodies, GrainsBelowTheFloorLeave) {
  SimulationSetup setup = packing_setup();
  setup.walls.clear();
  setup.floor_m = -.05;
  Simulation simulation = loose_packing(setup, 3);
  for (int k = 0; k < 100; ++k) simulation.advance(100);
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(simulation.is_present(k));
    EXPECT_LT(simulation.grain(k).position.z(), -.05);
    EXPECT_GT(simulation.grain(k).position.z(), -.06);  // and no longer moved
  }
  EXPECT_EQ(simulation.energies().kinetic_j, 0);
}

TEST(Bodies, RemovedGrainIsOutOfTheWay) {
  Simulation simulation = loose_packing(packing_setup(), 8);
  simulation.advance(8000);
  simulation.remove(0);
  simulation.advance(1);
  EXPECT_FALSE(simulation.is_present(0));
  EXPECT_EQ(simulation.grain_count(), 8);
  for (const ContactState& contact : simulation.contacts()) {
    EXPECT_NE(contact.grain_a, 0);
    EXPECT_NE(contact.grain_b, 0);
  }
}

TEST(Bodies, GrainAddedLaterHasTheNextNumberAndFalls) {
  Simulation simulation = loose_packing(packing_setup(), 2);
  simulation.advance(1000);
  Grain late = loose_grain(20);
  late.velocity.setZero();
  EXPECT_EQ(simulation.add(late), 2);
  simulation.advance(1);
  EXPECT_NEAR(simulation.grain(2).velocity.z(),
              -kStandardGravity_m_s2 * simulation.setup().timestep_s, 1e-15);
}

TEST(Bodies, RemovedWallLetsGrainsThrough) {
  SimulationSetup setup = packing_setup();
  setup.floor_m = -.5;
  Simulation simulation = loose_packing(setup, 4);
  simulation.advance(8000);
  simulation.remove_wall(0);
  simulation.advance(20000);
  for (int k = 0; k < 4; ++k) EXPECT_FALSE(simulation.is_present(k));
}

TEST(Bodies, MovingWallCarriesWhatLiesOnIt) {
  Simulation simulation = loose_packing(packing_setup(), 1);
  simulation.advance(30000);
  const double start = simulation.time_s();
  const double height = simulation.grain(0).position.z();
  simulation.set_motions(0, {{.velocity = {0, 0, .05}, .start_s = start}});
  simulation.advance(20000);
  EXPECT_NEAR(simulation.grain(0).position.z() - height, .05 * (simulation.time_s() - start), 1e-5);
}

TEST(SimulationSetup, ErrorsAreAllNamedAtOnce) {
  SimulationSetup setup = packing_setup();
  setup.timestep_s = 0;
  setup.threads = 0;
  setup.kinds[0].material = 9;
  setup.kinds[1].shape.spheres.clear();
  setup.walls[1].material = -1;
  EXPECT_THAT(
      error_of([&] { const Simulation simulation(setup); }),
      AllOf(HasSubstr("timestep_s is 0"), HasSubstr("threads is 0"),
            HasSubstr("grain kind 0: no such material"),
            HasSubstr("grain kind 1: it has no spheres"), HasSubstr("wall 1: no such material")));
}

TEST(SimulationSetup, ShapesThatCannotMoveAreRefused) {
  SimulationSetup setup = packing_setup();
  setup.kinds[0].shape.volume_m3 = 0;
  EXPECT_THROW(Simulation{setup}, base::InputError);
  setup = packing_setup();
  setup.kinds[0].shape.gyration_m2.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Simulation{setup}, base::InputError);
  setup = packing_setup();
  setup.kinds[0].shape.spheres[0].radius = -1;
  EXPECT_THROW(Simulation{setup}, base::InputError);
  setup = packing_setup();
  setup.timestep_s = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Simulation{setup}, base::InputError);
}

TEST(SimulationSetup, GrainsOfNoKindAreRefused) {
  Simulation simulation(packing_setup());
  Grain grain = loose_grain(0);
  grain.kind = 2;
  EXPECT_THROW(simulation.add(grain), base::InputError);
  grain.kind = -1;
  EXPECT_THROW(simulation.add(grain), base::InputError);
}

TEST(ContactTable, EveryBadValueIsNamed) {
  Material material{
      .name = "chalk", .density_kg_m3 = -1, .young_modulus_pa = 0, .poisson_ratio = .5};
  const PairCoefficients pair{
      .restitution = 1.2, .sliding_friction = -1, .rolling_friction = std::nan("")};
  EXPECT_THAT(error_of([&] { const ContactTable table({material}, {pair}, RollingModel::none); }),
              AllOf(HasSubstr("chalk: density_kg_m3 is -1"), HasSubstr("young_modulus_pa is 0"),
                    HasSubstr("poisson_ratio is 0.5"), HasSubstr("restitution is 1.2"),
                    HasSubstr("sliding_friction is -1"), HasSubstr("rolling_friction is nan")));
  material = {.name = "ok", .density_kg_m3 = 1, .young_modulus_pa = 1, .poisson_ratio = 0};
  EXPECT_THROW(ContactTable({material, material}, {{}}, RollingModel::none), base::InputError);
}

}  // namespace
}  // namespace repose::dem
