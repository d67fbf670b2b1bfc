#include "calibrate/published/published_method.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/study/study_problem.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::string kPublishedStudy = test::kSoftBall + R"([contact.particle_wall]
restitution = { min = 0.05, max = 0.9 }
sliding_friction = { min = 0.1, max = 0.8 }
rolling_friction = { min = 0.01, max = 0.2 }
[contact.particle_particle]
restitution = { min = 0.05, max = 0.9 }
sliding_friction = { min = 0.05, max = 0.8 }
rolling_friction = { min = 0, max = 0.3 }
[experiment.drop]
measured = { mean = 80, sd = 1, n = 10 }
[experiment.tilt]
measured = { mean = 22.7, sd = 1, n = 10 }
[experiment.roll]
measured = { mean = 320, sd = 30, n = 10 }
[experiment.heap]
measured = { mean = 21, sd = 0.7, n = 10 }
)";

/// Formulas instead of simulations.
class FormulaExecutor : public Executor {
 public:
  int workers() const override { return 1; }
  void run(const std::vector<Job>& jobs, const JobDone& done,
           const std::atomic<bool>& is_interrupted) override {
    for (std::size_t k = 0; k < jobs.size() && !is_interrupted; ++k) {
      RunResult result;
      result.seed = jobs[k].seed;
      const std::vector<double>& x = jobs[k].values;
      const double value = jobs[k].experiment == "drop"   ? 500 * x[0] * x[0]
                           : jobs[k].experiment == "tilt" ? std::atan(x[1]) * 180 / 3.14159265358979
                           : jobs[k].experiment == "roll"
                               ? 900 - 5000 * x[2]
                               : 10 + 30 * x[4] + 200 * x[5] + .01 * (jobs[k].seed % 3);
      const bool is_empty = jobs[k].experiment == "drop" && x[0] > fails_above_restitution;
      if (is_empty) {
        result.failure = "nothing was seen";
      } else {
        result.value = value;
      }
      done(k, result);
    }
  }
  double fails_above_restitution = 1;
};

class PublishedMethod : public ::testing::Test {
 protected:
  std::optional<PublishedOutcome> calibrate(const std::vector<std::string>& settings = {}) {
    const dem::Study study =
        dem::read_study(folder_.write("study.toml", kPublishedStudy), settings);
    const dem::ClumpFile grain = dem::build_grain(study.grain);
    const Problem problem = problem_of(study, grain, budget_named("quick")).problem;
    const StudySimulator simulator(study, grain, problem.parameters, 0);
    const RunStore folder(folder_.path() / "runs");
    const auto report = [this](const StudyProgress& now) {
      is_interrupted_ = now.stage == stop_at_;
    };
    return calibrate_as_published(problem, {simulator, folder, executor_, is_interrupted_, report});
  }

  TemporaryFolder folder_;
  FormulaExecutor executor_;
  std::atomic<bool> is_interrupted_ = false;
  std::string stop_at_;
};

TEST_F(PublishedMethod, SolvesEachSweepForWhatWasMeasured) {
  const auto outcome = calibrate();
  ASSERT_TRUE(outcome);
  ASSERT_THAT(outcome->sweeps, SizeIs(3));
  EXPECT_THAT(outcome->sweeps[0].levels, SizeIs(9));
  EXPECT_NEAR(outcome->sweeps[0].value, .4, 1e-9) << "500 e^2 = 80 is a parabola itself";
  EXPECT_NEAR(outcome->sweeps[1].value, std::tan(22.7 / 180 * 3.14159265358979), .01);
  EXPECT_NEAR(outcome->sweeps[2].value, .116, 1e-9);
  EXPECT_EQ(outcome->values[0], outcome->sweeps[0].value);
}

TEST_F(PublishedMethod, ClimbsToTheBestStepAndFitsTheErrorAroundIt) {
  const auto outcome = calibrate();
  ASSERT_TRUE(outcome);
  ASSERT_THAT(outcome->ascent, SizeIs(5));
  // 10 + 3 k + 2 k = 21: between the second and third step, nearer to the second.
  EXPECT_EQ(outcome->best_step, 1U);
  EXPECT_THAT(outcome->composite, SizeIs(20));
  EXPECT_THAT(outcome->surface.fit.coefficients, SizeIs(10));
  EXPECT_THAT(outcome->verification, SizeIs(10));
  EXPECT_THAT(outcome->checks, SizeIs(10));
  EXPECT_FALSE(outcome->surface.diagnostics.empty()) << "an absolute error has a kink";
}

TEST_F(PublishedMethod, LeavesOutRunsWithoutAReading) {
  executor_.fails_above_restitution = .75;
  const auto outcome = calibrate();
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->sweeps[0].levels, SizeIs(7));
  EXPECT_NEAR(outcome->sweeps[0].value, .4, 1e-9);
}

TEST_F(PublishedMethod, SaysWhenASweepDoesNotReachTheMeasurement) {
  const auto outcome = calibrate({"experiment.drop.measured.mean=499"});
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->sweeps[0].is_reached);
  EXPECT_NEAR(outcome->sweeps[0].value, .9, 1e-6) << "the nearest that there is";
}

TEST_F(PublishedMethod, GoesOnAfterAnInterruption) {
  stop_at_ = "central composite design";
  EXPECT_FALSE(calibrate());
  stop_at_.clear();
  is_interrupted_ = false;
  const auto outcome = calibrate();
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->composite, SizeIs(20));
}

TEST_F(PublishedMethod, NeedsAllSixSoughtAndAllFourMeasured) {
  const auto refusal = [&](const std::string& setting) {
    return error_of([&] { calibrate({setting}); });
  };
  EXPECT_THAT(refusal("contact.particle_wall.restitution=0.5"), HasSubstr("have no bounds"));
  const std::string tube = error_of([&] {
    calibrate({"wall.tube = { young_modulus_pa = 1e7, poisson_ratio = 0.4 }",
               "contact.particle_wall.restitution = 0.5",
               "contact.particle_tube = { restitution = { min = 0.1, max = 0.5 }, "
               "sliding_friction = 0.3, rolling_friction = 0.05 }"});
  });
  EXPECT_THAT(tube, HasSubstr("and nothing else")) << "six, but not these six";
  EXPECT_THAT(refusal("experiment.roll={}"), HasSubstr("[experiment.roll] has no measured value"));
}

}  // namespace
}  // namespace repose::calibrate
