#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/dem/experiment_model.h"
#include "tests/peers/exported.h"
#include "tests/peers/liggghts.h"

// Decks of the experiments between grains in LIGGGHTS, against our own: the same poses, the same
// beds.

namespace repose::testing {
namespace {

using calibrate::ExportTarget;
using dem::Experiment;

class BetweenGrains : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_liggghts()) GTEST_SKIP() << kNoLiggghts;
  }
};

/// Soft grains, and one experiment.
dem::Study study_of(const dem::Protocol& protocol, double restitution) {
  dem::Study study;
  study.model.grain_material = {"ball", 1000, 1e7, .3};
  study.model.wall_material = {"wall", 1000, 1e9, .25};
  study.model.grain_wall = {.7, .4, .1};
  study.model.grain_grain = {restitution, .4, .1};
  study.model.rolling = dem::RollingModel::relative_constant_torque;
  study.experiments[static_cast<Experiment>(protocol.index())].protocol = protocol;
  return study;
}

dem::Model model_of(const dem::Study& study, const dem::ClumpShape& grain) {
  dem::Model model = study.model;
  model.grain = grain;
  return model;
}

double our_swing_deg(const dem::Study& study, const dem::ClumpShape& grain) {
  return run_pendulum(model_of(study, grain), study.protocol<dem::PendulumProtocol>(), study.seed)
      .value;
}

double their_swing_deg(const dem::Study& study, const dem::ClumpShape& grain) {
  return reading_of(study, grain, ExportTarget::liggghts, "pendulum", "swing_deg");
}

// e = 2 sin(a / 2) / sin(b / 2) - 1 of a swing of a after a release at b. Low values come out some
// .002 too low, from steps that do not end when the contact does.
TEST_F(BetweenGrains, BallsOnStringsSwingAsTheClosedFormSays) {
  constexpr double kHalfDegree = std::numbers::pi / 360;
  for (const double restitution : {.1, .5, .9}) {
    const dem::Study study = study_of(dem::PendulumProtocol{.pairs = 2}, restitution);
    const dem::ClumpShape ball = dem::sphere_shape(.01);
    const double theirs = their_swing_deg(study, ball);
    EXPECT_NEAR(2 * std::sin(theirs * kHalfDegree) / std::sin(30 * kHalfDegree) - 1, restitution,
                .005);
    EXPECT_NEAR(theirs, our_swing_deg(study, ball), .05);
  }
}

// Pairs of clumps meet in the same poses. Where several of their spheres touch at once, dampers
// that may pull take a little more.
TEST_F(BetweenGrains, ClumpsOnStringsSwingAlike) {
  for (const double restitution : {.1, .5, .9}) {
    const dem::Study study = study_of(dem::PendulumProtocol{}, restitution);
    const dem::ClumpShape clump = dem::test::spheroid_clump(3);
    EXPECT_NEAR(their_swing_deg(study, clump), our_swing_deg(study, clump), .2);
  }
}

}  // namespace
}  // namespace repose::testing
