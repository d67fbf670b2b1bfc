#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "dem/engine/unstable_run.h"
#include "dem/experiment/draw_down.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kBall_m = .02;
/// Beverloo's k d.
constexpr double kGap_m = 1.4 * kBall_m;

/// Balls of 20 mm, soft and damped to keep runs short.
Model balls(const PairCoefficients& between = {.1, .4, .1}) {
  Model model = test::sphere_bench();
  model.grain = sphere_shape(.5 * kBall_m);
  model.grain_material = {"ball", 1000, 1e6, .3};
  model.grain_wall = {.1, .4, .1};
  model.grain_grain = between;
  return model;
}

constexpr DrawDownProtocol kBoxes{
    .length_m = .26, .depth_m = .08, .slot_m = .1, .fill_m = .08, .drop_m = .14};

std::string no_reading_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const NoMeasurement& error) {
    return error.what();
  }
  return "a reading";
}

/// Shared by the tests that only inspect it.
const Repeat& usual() {
  static const Repeat repeat = run_draw_down(balls(), kBoxes, 1);
  return repeat;
}

TEST(DrawDown, WhatRunsOutAndWhatStaysIsTheFill) {
  const auto& readings = usual().readings;
  int below = 0, above = 0;
  for (int k = 0; k < usual().state->grain_count(); ++k) {
    if (!usual().state->is_present(k)) continue;
    (usual().state->grain(k).position.z() < kBoxes.drop_m ? below : above) += 1;
  }
  const double ball_g = 1e6 * std::numbers::pi / 6 * std::pow(kBall_m, 3);
  EXPECT_GT(above, 20);
  EXPECT_EQ(readings.at("grains_out"), below);
  EXPECT_EQ(readings.at("grains"), below + above);
  EXPECT_NEAR(readings.at("discharged_g"), ball_g * below, 1e-6);
  EXPECT_NEAR(readings.at("filled_g"), ball_g * (below + above), 1e-6);
  EXPECT_NEAR(usual().value.value(), 100. * below / (below + above), 1e-9);
  EXPECT_EQ(readings.at("at_rest"), 1);
}

TEST(DrawDown, GrainsStayBetweenThePanes) {
  const double room_x = .5 * kBoxes.length_m - .45 * kBall_m;
  const double room_y = .5 * kBoxes.depth_m - .45 * kBall_m;
  for (int k = 0; k < usual().state->grain_count(); ++k) {
    if (!usual().state->is_present(k)) continue;
    const Vector& place = usual().state->grain(k).position;
    EXPECT_LT(std::abs(place.x()), room_x);
    EXPECT_LT(std::abs(place.y()), room_y);
    EXPECT_GT(place.z(), .45 * kBall_m);
  }
}

TEST(DrawDown, FrictionKeepsGrainsAboveTheSlot) {
  EXPECT_GT(run_draw_down(balls({.1, .2, .05}), kBoxes, 1).value.value(),
            usual().value.value() + 2);
}

/// Mass flow through a slot by the law of Beverloo, Leniger and van de Velde (1961), The flow of
/// granular solids through orifices, Chemical Engineering Science 15, 260, in its form for slots
/// (Nedderman, Tuzun, Savage and Houlsby 1982, Chemical Engineering Science 37, 1597):
///
///     Q = 1.03 r sqrt(g) L (W - k d)^(3/2)
///
///     r bulk density, L length of the slot, W its width, d diameter of the grains, k 1.4 (1.2
///     to 1.6)
///
/// Holds for W above about 5 d. Centres of grains come no closer than d / 2 to a pane, and no
/// closer than k d / 2 to an open end of a slot: between panes L is therefore between the depth of
/// the box and that minus k d.
double beverloo_g_s(const Repeat& repeat, const DrawDownProtocol& boxes, double length_m) {
  constexpr double kRate = 1.03;
  const double bulk_g_m3 =
      repeat.readings.at("filled_g") / (boxes.length_m * boxes.depth_m * boxes.fill_m);
  return kRate * bulk_g_m3 * std::sqrt(kStandardGravity_m_s2) * length_m *
         std::pow(boxes.slot_m - kGap_m, 1.5);
}

TEST(DrawDowns, RunOutAsFastAsBeverloosLawSays) {
  Model model = balls({.1, .3, .2});
  model.grain_wall = {.1, .05, .2};  // the law neglects friction at the panes
  std::vector<double> of_the_law;
  for (const double slot_m : {.1, .14}) {
    const DrawDownProtocol boxes{
        .length_m = slot_m + .18, .depth_m = .08, .slot_m = slot_m, .fill_m = .12, .drop_m = .2};
    const Repeat repeat = run_draw_down(model, boxes, 1);
    const double rate_g_s = repeat.readings.at("rate_g_s");
    EXPECT_LT(rate_g_s, beverloo_g_s(repeat, boxes, boxes.depth_m)) << slot_m;
    EXPECT_GT(rate_g_s, beverloo_g_s(repeat, boxes, boxes.depth_m - kGap_m)) << slot_m;
    of_the_law.push_back(rate_g_s / beverloo_g_s(repeat, boxes, boxes.depth_m));
  }
  // Between these widths the law's rate rises by a factor of 1.94; proportional to the width it
  // would rise by 1.4, which is .72 of that, and with the power 5/2 by 2.32, 1.2 of it.
  EXPECT_NEAR(of_the_law[1] / of_the_law[0], 1, .15);
}

TEST(DrawDownThreads, GiveTheSame) {
  Model two = balls();
  two.threads = 2;
  EXPECT_TRUE(test::same_state(*usual().state, *run_draw_down(two, kBoxes, 1).state));
}

TEST(DrawDown, TellsEveryErrorAtOnce) {
  EXPECT_THAT(error_of([] {
                run_draw_down(
                    balls(),
                    {.length_m = .2, .depth_m = .03, .slot_m = .09, .fill_m = .05, .drop_m = .09},
                    1);
              }),
              AllOf(HasSubstr("draw_down.length_m is 0.2. Rule: the slot and 4 grain lengths on"),
                    HasSubstr("draw_down.depth_m is 0.03"),
                    HasSubstr("draw_down.slot_m is 0.09. Rule: 5 grain lengths"),
                    HasSubstr("draw_down.fill_m is 0.05"),
                    HasSubstr("draw_down.drop_m is 0.09. Rule: the lower heap must not reach")));
  EXPECT_THAT(error_of([] {
                run_draw_down(balls(),
                              {.length_m = 5, .depth_m = 1, .slot_m = .1, .fill_m = 2, .drop_m = 4},
                              1);
              }),
              HasSubstr("Rule: at most 100000. Fix: a smaller box or a lower fill"));
}

TEST(DrawDown, SaysWhenNoSlopeStays) {
  Model ice = balls({.6, .01, .02});
  ice.grain_wall = {.6, .01, .02};
  EXPECT_THAT(no_reading_of([&] { run_draw_down(ice, kBoxes, 1); }),
              HasSubstr("grains run out, and no slope stays above. Fix: a longer box"));
}

TEST(DrawDown, SaysWhenGrainsArchOverTheSlot) {
  Model rough = balls({.05, 5, 3});
  rough.grain_wall = {.05, 5, 3};
  constexpr DrawDownProtocol kHigher{
      .length_m = .28, .depth_m = .08, .slot_m = .1, .fill_m = .1, .drop_m = .16};
  EXPECT_THAT(no_reading_of([&] { run_draw_down(rough, kHigher, 1); }),
              HasSubstr("draw_down: grains arch over the slot once"));
}

TEST(DrawDown, GrainsThatAreTooSoftStopTheRun) {
  Model soft = balls();
  soft.grain_material.young_modulus_pa = 1e3;
  EXPECT_THROW(run_draw_down(soft, kBoxes, 1), UnstableRun);
}

}  // namespace
}  // namespace repose::dem
