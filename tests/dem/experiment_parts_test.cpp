#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>

#include "dem/experiment/draw_down.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

constexpr HeapProtocol kSmallTube{
    .tube_diameter_m = .07, .tube_height_m = .1, .lift_speed_m_s = .1, .plate_m = .3, .grains = {}};

Model with_part(Model model, WallPart part, const PairCoefficients& with_grain) {
  model.parts[part] = {.material = model.wall_material, .with_grain = with_grain};
  return model;
}

TEST(WallParts, OfThePlatesMaterialChangeNothing) {
  const Model model = test::soft_bench();
  const auto same = [&](WallPart part, const std::function<Repeat(const Model&)>& run) {
    const Repeat plain = run(model);
    const Repeat parted = run(with_part(model, part, model.grain_wall));
    return test::same_state(*plain.state, *parted.state) && plain.readings == parted.readings;
  };
  EXPECT_TRUE(same(WallPart::tube, [](const Model& m) { return run_heap(m, kSmallTube, 1); }));
  EXPECT_TRUE(same(WallPart::incline, [](const Model& m) { return run_roll(m, {}, 1); }));
}

TEST(WallParts, EachPairHasItsOwnLaw) {
  Model model = with_part(test::sphere_bench(), WallPart::incline, {.6, .1, .02});
  model.parts[WallPart::incline].material.young_modulus_pa = 3e9;
  model.parts[WallPart::pane] = {.material = {"glass", 2500, 7e10, .2},
                                 .with_grain = {.8, .3, .01}};
  EXPECT_EQ(material_of(model, WallPart::tube), kWallMaterial);
  const int incline = material_of(model, WallPart::incline);
  const int pane = material_of(model, WallPart::pane);
  const ContactTable table = model_setup(model, model.grain, {study_wall(Plane{})}, 1).contacts;
  ASSERT_EQ(table.size(), 4);
  for (const auto& [material, friction] :
       {std::pair(kGrainMaterial, .21), {kWallMaterial, .39}, {incline, .1}, {pane, .3}}) {
    EXPECT_EQ(table.pair(kGrainMaterial, material).sliding_friction, friction);
    EXPECT_EQ(table.pair(material, kGrainMaterial).sliding_friction, friction);
  }
  // 1/E* = sum (1 - nu^2) / E (Johnson 1985, eq. 4.24).
  const double compliance = (1 - .38 * .38) / 1.254e9 + (1 - .3 * .3) / 3e9;
  EXPECT_NEAR(table.law(kGrainMaterial, incline).reduced_young_pa, 1 / compliance, 1);
}

// A ball that rolls down an incline and along a flat of different friction, by energy and with the
// loss at the foot. Against the rolling torque v^2 = 10/7 g s (sin - mu_r cos) on both stretches;
// at the foot the ball lands on the flat and keeps r = (5 cos + 2) / 7 - 5/7 mu_r sin of its speed
// (angular momentum about the new point of contact, less the flat's rolling friction on the
// impulse):
// L = r^2 S' (sin - mu_incline cos) / mu_flat + R tan(slope / 2), S' = S - R tan(slope / 2).
double by_energy_and_foot_mm(double slope_deg, double release_m, double radius_m, double mu_incline,
                             double mu_flat) {
  const double slope = slope_deg * std::numbers::pi / 180;
  const double foot = radius_m * std::tan(slope / 2);
  const double kept = (5 * std::cos(slope) + 2) / 7 - 5 * mu_flat * std::sin(slope) / 7;
  return 1e3 * (kept * kept * (release_m - foot) *
                    (std::sin(slope) - mu_incline * std::cos(slope)) / mu_flat +
                foot);
}

struct TwoFrictions {
  double incline;
  double flat;
};

class RollOverTwoMaterials : public ::testing::TestWithParam<TwoFrictions> {};

TEST_P(RollOverTwoMaterials, GoesAsFarAsEnergyAllows) {
  Model model = test::sphere_bench();
  model.grain_wall = {.05, .8, GetParam().flat};
  model = with_part(model, WallPart::incline, {.05, .8, GetParam().incline});
  const double expected_mm =
      by_energy_and_foot_mm(20, .15, 9.6349e-3, GetParam().incline, GetParam().flat);
  EXPECT_NEAR(run_roll(model, {}, 1).value.value(), expected_mm, .001 * expected_mm);
}

INSTANTIATE_TEST_SUITE_P(Frictions, RollOverTwoMaterials,
                         ::testing::Values(TwoFrictions{.02, .1}, TwoFrictions{.1, .05},
                                           TwoFrictions{.2, .1}, TwoFrictions{.05, .05}));

TEST(WallParts, ATiltIsOfThePlateAlone) {
  Model model = test::sphere_bench();
  const double value = run_tilt(model, {.rate_deg_s = 10}, 1).value.value();
  for (const WallPart part : {WallPart::tube, WallPart::incline, WallPart::pane}) {
    model = with_part(model, part, {.9, .01, .3});
  }
  EXPECT_EQ(run_tilt(model, {.rate_deg_s = 10}, 1).value.value(), value);
  EXPECT_NEAR(value, std::atan(.39) * 180 / std::numbers::pi, .1);
}

TEST(WallParts, ARoughTubeHoldsALooserFill) {
  constexpr FillProtocol kNarrow{.tube_diameter_m = .09, .tube_height_m = .12};
  const Model model = test::soft_bench();
  const Repeat smooth = run_fill(with_part(model, WallPart::tube, {.31, 0, 0}), kNarrow, 1);
  const Repeat rough = run_fill(with_part(model, WallPart::tube, {.31, 2, .5}), kNarrow, 1);
  EXPECT_GT(smooth.value.value(), rough.value.value() + 5);
}

TEST(WallParts, AFrictionlessTubeLeavesAnotherHeapThanARoughOne) {
  const Model model = test::soft_bench();
  const Repeat smooth = run_heap(with_part(model, WallPart::tube, {.31, 0, 0}), kSmallTube, 1);
  const Repeat rough = run_heap(with_part(model, WallPart::tube, {.31, .5, .2}), kSmallTube, 1);
  EXPECT_FALSE(test::same_state(*smooth.state, *rough.state));
  EXPECT_TRUE(test::same_state(*rough.state, *run_heap(model, kSmallTube, 1).state));
}

TEST(WallParts, PanesCarryGrainsAndFloorsDoNotKnowIt) {
  constexpr DrawDownProtocol boxes{
      .length_m = .26, .depth_m = .08, .slot_m = .1, .fill_m = .08, .drop_m = .14};
  Model model = test::sphere_bench();
  model.grain = sphere_shape(.01);
  model.grain_material = {"ball", 1000, 1e6, .3};
  model.grain_wall = {.1, .4, .1};
  model.grain_grain = {.1, .4, .1};
  const Repeat smooth = run_draw_down(with_part(model, WallPart::pane, {.1, 0, 0}), boxes, 1);
  const Repeat rough = run_draw_down(with_part(model, WallPart::pane, {.1, 1, .3}), boxes, 1);
  // Friction at the panes holds back part of the discharge, and slopes are steeper.
  EXPECT_GT(smooth.value.value(), rough.value.value() + 2);
}

}  // namespace
}  // namespace repose::dem
