#include "render/scene/scene.h"

#include <gmock/gmock.h>

#include "render/scene/extent.h"
#include "tests/support/nut_heap.h"
#include "tests/support/temporary_folder.h"

namespace repose::render {
namespace {

using repose::testing::TemporaryFolder;

dem::Simulation small_run() {
  const dem::ContactTable contacts(
      {{.name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 1e7, .poisson_ratio = .25}},
      {dem::PairCoefficients{}}, dem::RollingModel::none);
  dem::SimulationSetup setup{
      .kinds = {{dem::sphere_shape(.01), 0}}, .walls = {}, .contacts = contacts};
  setup.timestep_s = 1e-4;
  setup.walls = {{.shape = dem::Plane{}},
                 {.shape = dem::Tube{.inner_radius = .1, .thickness = .01, .height = .3},
                  .motions = {{.velocity = {0, 0, 1}}}}};
  dem::Simulation run(setup);
  for (int k = 0; k < 3; ++k) run.add({.position = {.05 * k, 0, .5}});
  run.remove(1);
  run.advance(100);
  return run;
}

TEST(Scene, ShowsWhatIsPresentWhereItIsNow) {
  const dem::Simulation run = small_run();
  const Scene scene = scene_of(run);
  ASSERT_EQ(scene.grains.size(), 2U);
  EXPECT_EQ(scene.grains[1].number, 2);
  EXPECT_EQ(scene.grains[1].pose.position, run.grain(2).position);
  ASSERT_EQ(scene.walls.size(), 2U);
  EXPECT_NEAR(scene.walls[1].pose.position.z(), .01, 1e-12);
}

TEST(Scene, ASavedStateShowsTheSame) {
  const TemporaryFolder folder;
  dem::Simulation run = small_run();
  run.remove_wall(1);
  dem::write_state(folder.path() / "state.vtp", run, "{}");
  const Scene live = scene_of(run);
  const Scene saved = scene_of(dem::read_state(folder.path() / "state.vtp"));
  ASSERT_EQ(saved.grains.size(), live.grains.size());
  for (std::size_t k = 0; k < live.grains.size(); ++k) {
    EXPECT_EQ(saved.grains[k].number, live.grains[k].number);
    EXPECT_EQ(saved.grains[k].pose.position, live.grains[k].pose.position);
  }
  ASSERT_EQ(saved.walls.size(), 1U);
  EXPECT_EQ(live.walls.size(), 1U);
}

TEST(Scene, UprightPlanesArePanes) {
  const auto leaning = [](const dem::Vector& normal) {
    return PlacedWall{
        .shape = dem::Plane{},
        .pose = {.orientation = dem::Quaternion::FromTwoVectors(dem::Vector::UnitZ(), normal)}};
  };
  EXPECT_TRUE(is_pane(leaning({0, 1, 0})));
  EXPECT_TRUE(is_pane(leaning({-1, 0, 0})));
  EXPECT_FALSE(is_pane(leaning({0, 0, 1})));
  EXPECT_FALSE(is_pane(leaning({0, 1, .1})));
  EXPECT_FALSE(is_pane({.shape = dem::Box{.half_size = {1, 1, 1}}, .pose = {}}));
}

TEST(Scene, TheGroundIsTheHighestLevelFaceBelowTheGrains) {
  Scene scene = repose::testing::sphere_scene(.01, {{0, 0, .1}});
  EXPECT_FALSE(ground_m(scene));
  scene.walls.push_back({.shape = dem::Plane{}, .pose = {.position = {0, 0, -.5}}});
  EXPECT_EQ(ground_m(scene), -.5);
  scene.walls.push_back(repose::testing::plate(1));
  EXPECT_EQ(ground_m(scene), 0);
  scene.walls.push_back(
      {.shape = dem::Box{.half_size = {1, 1, .1}}, .pose = {.position = {0, 0, 1}}});  // a lid
  EXPECT_EQ(ground_m(scene), 0);
}

}  // namespace
}  // namespace repose::render
