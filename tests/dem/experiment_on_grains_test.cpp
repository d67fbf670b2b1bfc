#include <gmock/gmock.h>

#include "dem/engine/unstable_run.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/tilt_on_grains.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Glass beads of 6 mm, soft to keep runs short.
Model beads() {
  Model model = test::sphere_bench();
  model.grain = sphere_shape(.003);
  model.grain_material = {"glass", 2500, 6e6, .22};
  model.grain_grain = {.5, .4, .1};
  return model;
}

double tilt_deg(const Model& model) {
  return run_tilt_on_grains(model, {.rate_deg_s = 10, .places = 8}, 1).value.value();
}

double roll_deg(const Model& model) {
  return run_roll_on_grains(model, {.rate_deg_s = 10, .places = 8}, 1).value.value();
}

double drop_mm(const Model& model) {
  return run_drop_on_grains(model, {.grains = 100}, 1).value.value();
}

TEST(TiltOnGrains, TellsSlidingFrictionAndIsSteeperThanIt) {
  Model smooth = beads(), rough = beads();
  smooth.grain_grain.sliding_friction = .2;
  rough.grain_grain.sliding_friction = .6;
  const double least = tilt_deg(smooth), most = tilt_deg(rough);
  EXPECT_GT(least, std::atan(.2) * 180 / std::numbers::pi);
  EXPECT_GT(most, std::atan(.6) * 180 / std::numbers::pi);
  EXPECT_GT(most, least + 8);
}

TEST(RollOnGrains, TellsRollingFrictionAlone) {
  Model low = beads(), high = beads(), smooth = beads();
  low.grain_grain.rolling_friction = .02;
  high.grain_grain.rolling_friction = .2;
  smooth.grain_grain.sliding_friction = .25;
  EXPECT_GT(roll_deg(high), roll_deg(low) + 6);
  EXPECT_NEAR(roll_deg(smooth), roll_deg(beads()), 3);
}

TEST(RollOnGrains, WithoutResistanceBallsLeaveHollowsNoEarlierThanFromCloseOnes) {
  // asin(1/3) = 19.5 degrees between two touching balls; the hollows of a random bed are deeper.
  Model model = beads();
  model.grain_grain.rolling_friction = 0;
  EXPECT_GT(roll_deg(model), 19.5);
  EXPECT_LT(roll_deg(model), 45);
}

TEST(DropOnGrains, TellsRestitution) {
  Model low = beads(), high = beads();
  low.grain_grain.restitution = .2;
  high.grain_grain.restitution = .8;
  EXPECT_GT(drop_mm(high), 8 * drop_mm(low));
}

/// All readings of one small run of each experiment.
std::vector<double> small_runs(const Model& model) {
  return {run_tilt_on_grains(model, {.rate_deg_s = 10, .places = 2}, 1).value.value(),
          run_roll_on_grains(model, {.rate_deg_s = 10, .places = 2}, 1).value.value(),
          run_drop_on_grains(model, {.grains = 5}, 1).value.value()};
}

TEST(OnGrains, WallsHaveNoEffect) {
  Model other = beads();
  other.grain_wall = {.9, .05, .3};
  EXPECT_EQ(small_runs(other), small_runs(beads()));
}

TEST(OnGrainsThreads, GiveTheSame) {
  Model two = beads();
  two.threads = 2;
  EXPECT_EQ(small_runs(two), small_runs(beads()));
}

TEST(OnGrains, TellEveryErrorAtOnce) {
  EXPECT_THAT(
      error_of([] {
        run_tilt_on_grains(beads(), {.bonded = 0, .rate_deg_s = 50, .places = 0, .coverage = .5},
                           1);
      }),
      AllOf(HasSubstr("tilt_on_grains.coverage is 0.5"), HasSubstr("holes that a grain falls into"),
            HasSubstr("tilt_on_grains.bonded is 0"), HasSubstr("tilt_on_grains.places is 0"),
            HasSubstr("tilt_on_grains.rate_deg_s is 50")));
  EXPECT_THAT(
      error_of(
          [] { run_drop_on_grains(beads(), {.height_m = -1, .grains = 0, .coverage = .9}, 1); }),
      AllOf(HasSubstr("drop_on_grains.coverage is 0.9"), HasSubstr("drop_on_grains.height_m is -1"),
            HasSubstr("drop_on_grains.grains is 0")));
  EXPECT_THAT(error_of([] { run_roll_on_grains(beads(), {.rate_deg_s = 0, .coverage = 2}, 1); }),
              AllOf(HasSubstr("roll_on_grains.coverage is 2"),
                    HasSubstr("roll_on_grains.rate_deg_s is 0")));
}

TEST(OnGrains, GrainsThatAreTooSoftStopTheRun) {
  Model soft = beads();
  soft.grain_material.young_modulus_pa = 2e3;
  EXPECT_THROW(run_drop_on_grains(soft, {}, 1), UnstableRun);
}

}  // namespace
}  // namespace repose::dem
