#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem/experiment/tilt.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

double friction_deg(double friction) { return std::atan(friction) * 180 / std::numbers::pi; }

class TiltFriction : public ::testing::TestWithParam<double> {};

TEST_P(TiltFriction, IsTheAngleOfSliding) {
  Model model = test::clump_bench();
  model.grain_wall.sliding_friction = GetParam();
  const Repeat repeat = run_tilt(model, {}, 1);
  EXPECT_NEAR(repeat.value.value(), friction_deg(GetParam()), .02);
  // Slip becomes visible with a delay: g sin(rate t) t^2 / 6 = .5 mm after .2 s, .4 degrees.
  EXPECT_NEAR(repeat.readings.at("half_mm_slip_deg"), friction_deg(GetParam()) + .4, .05);
}

INSTANTIATE_TEST_SUITE_P(Tilt, TiltFriction, ::testing::Values(.1, .39, .8));

/// Contacts that dissipate little rattle on a plate about to release them, and creep before that.
TEST(Tilt, RestitutionDoesNotMatter) {
  Model glass = test::sphere_bench();
  glass.grain = sphere_shape(5e-3);
  glass.grain_material = glass.wall_material = {"glass", 2500, 6e10, .22};
  for (Model model : {glass, test::clump_bench()}) {
    for (const auto& [restitution, friction] :
         {std::pair{.5, .9}, {.6, .9}, {.8, .9}, {.9, .7}, {.95, .4}, {.99, .2}, {1., .9}}) {
      model.grain_wall = {restitution, friction, .05};
      const Repeat repeat = run_tilt(model, {.rate_deg_s = 5}, 1);
      EXPECT_NEAR(repeat.value.value(), friction_deg(friction), .02) << restitution;
      EXPECT_GT(repeat.value.value(), repeat.readings.at("begin_deg"));
    }
  }
}

TEST(Tilt, SpheresAndClumpsAlike) {
  EXPECT_NEAR(run_tilt(test::sphere_bench(), {}, 1).value.value(), friction_deg(.39), .02);
}

TEST(Tilt, IrregularGrainsSlideAtTheSameAngle) {
  Model model = test::sphere_bench();
  model.grain.spheres = {{.centre = {-5e-3, 0, 0}, .radius = 7e-3},
                         {.centre = {6e-3, 2e-3, -1e-3}, .radius = 6e-3},
                         {.centre = {0, -3e-3, 2e-3}, .radius = 8e-3}};
  model.grain.gyration_m2 = {2e-5, 3e-5, 4e-5};
  EXPECT_NEAR(run_tilt(model, {.bonded = 3}, 1).value.value(), friction_deg(.39), .05);
}

TEST(Tilt, SofteningDoesNotChangeTheAngle) {
  Model model = test::clump_bench();
  model.stiffness_factor = .001;
  EXPECT_NEAR(run_tilt(model, {}, 1).value.value(), friction_deg(.39), .03);
}

TEST(Tilt, DoesNotDependOnWhereItBegins) {
  Model model = test::clump_bench();
  model.grain_wall.sliding_friction = .1;
  const Repeat late = run_tilt(model, {.start_deg = 5.4}, 1);
  const Repeat early = run_tilt(model, {.start_deg = 0}, 1);
  EXPECT_EQ(late.readings.at("begin_deg"), 5.4);
  EXPECT_LT(early.readings.at("begin_deg"), 5);
  EXPECT_NEAR(late.value.value(), early.value.value(), .005);
}

TEST(Tilt, DoesNotDependOnTheRate) {
  Model model = test::clump_bench();
  const double slow = run_tilt(model, {.rate_deg_s = 2}, 1).value.value();
  const double fast = run_tilt(model, {.rate_deg_s = 10}, 1).value.value();
  EXPECT_NEAR(slow, fast, .02);
}

TEST(Tilt, GrainsTipWhenFrictionHoldsThem) {
  Model model = test::clump_bench();
  model.grain_wall.sliding_friction = 1.3;
  const std::string message =
      error_of<NoMeasurement>([&] { run_tilt(model, {.rate_deg_s = 10}, 1); });
  EXPECT_NE(message.find("tipped"), std::string::npos) << message;
}

TEST(Tilt, ASingleGrainRolls) {
  const std::string message = error_of<NoMeasurement>(
      [&] { run_tilt(test::sphere_bench(), {.bonded = 1, .rate_deg_s = 10}, 1); });
  EXPECT_NE(message.find("rolled"), std::string::npos) << message;
}

TEST(Tilt, BeginningAboveTheAngleOfFrictionIsNoReading) {
  const std::string message =
      error_of<NoMeasurement>([] { run_tilt(test::clump_bench(), {.start_deg = 30}, 1); });
  EXPECT_NE(message.find("holds up to 21.31 degrees. Fix: start_deg = 0"), std::string::npos)
      << message;
}

TEST(Tilt, NoReadingIsBelowWhereThePlateBegins) {
  Model model = test::clump_bench();
  model.grain_wall.sliding_friction = .1;  // slides at 5.711
  const std::string creeps =
      error_of<NoMeasurement>([&] { run_tilt(model, {.start_deg = 5.7}, 1); });
  EXPECT_NE(creeps.find("creeps from 5.70 degrees on"), std::string::npos) << creeps;
  EXPECT_NE(creeps.find("Fix: start_deg = 0"), std::string::npos) << creeps;
}

TEST(Tilt, FramesShowThePlateFromLevelUntilTheGrainsHaveSlid) {
  const Model model = test::sphere_bench();
  const TiltProtocol protocol{.rate_deg_s = 10};
  RunRecord record;
  record.frame_interval_s = .01;
  std::vector<double> angles_deg, along_m;
  record.frame = [&](const Simulation& simulation) {
    const Quaternion& turn = simulation.wall(0).pose.orientation;
    angles_deg.push_back(2 * std::asin(turn.y()) * 180 / std::numbers::pi);
    along_m.push_back((turn.conjugate() * simulation.grain(0).position).x());
  };
  const Repeat filmed = run_tilt(model, protocol, 1, {}, record);
  const Repeat read = run_tilt(model, protocol, 1);
  EXPECT_EQ(filmed.value.value(), read.value.value());
  EXPECT_EQ(filmed.steps, read.steps);
  ASSERT_GT(angles_deg.size(), 100U);
  EXPECT_NEAR(angles_deg.front(), 0, 1e-9);
  EXPECT_GT(angles_deg.back(), read.value.value());
  EXPECT_GT(along_m.back() - along_m.front(), 9 * model.grain.reach_m());
  // It slides at the angle that is reported, and not before.
  for (std::size_t k = 0; k < angles_deg.size(); ++k) {
    if (angles_deg[k] > read.value.value() - .2) break;
    EXPECT_NEAR(along_m[k], along_m.front(), 1e-5) << angles_deg[k];
  }
}

TEST(Tilt, HasNoChanceInIt) {
  Model model = test::clump_bench();
  const Repeat one = run_tilt(model, {.rate_deg_s = 10}, 1);
  model.threads = 2;
  const Repeat two = run_tilt(model, {.rate_deg_s = 10}, 2);
  EXPECT_EQ(one.value.value(), two.value.value());
  EXPECT_TRUE(test::same_state(*one.state, *two.state));
}

TEST(Tilt, TellsEveryErrorAtOnce) {
  const std::string message = error_of(
      [&] { run_tilt(test::sphere_bench(), {.bonded = 0, .rate_deg_s = 0, .start_deg = 95}, 1); });
  for (const char* name : {"tilt.bonded", "tilt.rate_deg_s", "tilt.start_deg"}) {
    EXPECT_NE(message.find(name), std::string::npos) << name << " in:\n" << message;
  }
}

}  // namespace
}  // namespace repose::dem
