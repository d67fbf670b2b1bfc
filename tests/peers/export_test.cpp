#include <gtest/gtest.h>

#include "tests/dem/experiment_model.h"
#include "tests/peers/exported.h"

// Exported decks in their target programs, compared with our own experiments: same poses, same
// distances. Limits are fractions of our reading; for the tilt, degrees.

namespace repose::testing {
namespace {

using calibrate::ExportTarget;
using dem::RollingModel;

/// Allowed deviations of the other program.
struct Limits {
  double drop = 0;
  double tilt_deg = 0;
  double roll = 0;
};

class Export : public ::testing::TestWithParam<ExportTarget> {
 protected:
  static void expect_alike(const dem::Study& study, const dem::ClumpShape& grain,
                           const Limits& limits, ExportTarget target) {
    const Readings ours = our_readings(study, grain);
    const Readings theirs = readings_of(study, grain, target);
    EXPECT_NEAR(theirs.drop_mm, ours.drop_mm, limits.drop * ours.drop_mm);
    EXPECT_NEAR(theirs.tilt_deg, ours.tilt_deg, limits.tilt_deg);
    EXPECT_NEAR(theirs.roll_mm, ours.roll_mm, limits.roll * ours.roll_mm);
  }

  void SetUp() override {
    if (!has_program_for(GetParam())) {
      GTEST_SKIP() << name_of(GetParam()) << " is not installed; nothing was compared. Fix: "
                   << "apt-get install liggghts lammps yade";
    }
  }
};

/// In LAMMPS and YADE rolling friction comes from a spring too soft to be wound up by an impact.
bool has_soft_rolling_spring(ExportTarget target) { return target != calibrate::liggghts_target(); }

// Under gravity, a damper that may pull makes a ball rebound slightly higher than ours: by 1 % of
// the height. The tilt angle is sampled every .02 degrees, after the slip.
TEST_P(Export, SphereReadsAlike) {
  expect_alike(short_study(RollingModel::constant_torque), dem::sphere_shape(.01),
               {.drop = .015, .tilt_deg = .05, .roll = .01}, GetParam());
}

// The springs of ours and of LIGGGHTS have a damper, which takes spin when the ball lands at the
// foot of the incline: 16 % of the distance.
TEST_P(Export, SphereWithARollingSpringReadsAlike) {
  expect_alike(
      short_study(RollingModel::elastic_plastic), dem::sphere_shape(.01),
      {.drop = .015, .tilt_deg = .05, .roll = has_soft_rolling_spring(GetParam()) ? .22 : .025},
      GetParam());
}

// Two effects lower a clump's rebound there: dampers that may pull, if several spheres land; and
// spin that no rolling friction takes, if springs are soft. Rolling friction is converted with the
// mean lever of lying poses.
TEST_P(Export, ClumpReadsAlike) {
  expect_alike(
      short_study(RollingModel::constant_torque), dem::test::spheroid_clump(3),
      {.drop = has_soft_rolling_spring(GetParam()) ? .16 : .04, .tilt_deg = .05, .roll = .05},
      GetParam());
}

// Low values show whether the damping is converted: the textbook factor without pull gives .33
// instead of .2, which is 170 % more height.
TEST_P(Export, LowRestitutionComesOut) {
  expect_alike(short_study(RollingModel::relative_constant_torque, .2), dem::sphere_shape(.01),
               {.drop = .06, .tilt_deg = .07, .roll = .015}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Programs, Export,
                         ::testing::Values(calibrate::liggghts_target(), calibrate::lammps_target(),
                                           calibrate::yade_target()),
                         [](const auto& each) { return name_of(each.param); });

}  // namespace
}  // namespace repose::testing
