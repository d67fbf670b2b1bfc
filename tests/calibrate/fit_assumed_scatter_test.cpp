// Verdicts that rest on assumed scatter, where nobody measured it.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/assumed_scatter.h"
#include "calibrate/result/result_text.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/calibrate/made_up_result.h"

namespace repose::calibrate {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

double width_of(const Interval& interval) { return interval.high - interval.low; }

/// Drop, tilt and roll alone: the first three coefficients.
Problem without_heap() {
  Problem problem = fake::problem();
  std::erase_if(problem.observables,
                [](const Observable& one) { return one.experiment == "heap"; });
  std::erase_if(problem.experiments, [](const Experiment& one) { return one.name == "heap"; });
  problem.parameters.resize(3);
  return problem;
}

/// A bench of which only the mean of the rolls is known, not their scatter.
Problem of_unknown_rolls(double fraction) {
  Problem problem = without_heap();
  Observable& roll = *std::ranges::find(problem.observables, "roll", &Observable::name);
  roll.sd.reset();
  roll.assumed_sd_fraction = fraction;
  return problem;
}

TEST(AssumedScatter, IsNoneWhereAllWasMeasured) {
  const Problem problem = without_heap();
  const fake::Runs runs = fake::first_runs(problem);
  const AssumedScatters found = assumed_scatters(problem, runs, fit_jointly(problem, runs));
  EXPECT_THAT(found.readings, IsEmpty());
  EXPECT_THAT(found.coefficients, IsEmpty());
}

// Fits with half or twice the assumed scatter stated explicitly give the same results.
TEST(AssumedScatter, IsHalvedAndDoubledAsIfItHadBeenAssumedSo) {
  constexpr double kAssumed = 1.2;  // more than the random scatter, even when halved
  const Problem problem = of_unknown_rolls(kAssumed);
  const fake::Runs runs = fake::first_runs(problem);
  const JointFit fit = fit_jointly(problem, runs);
  const AssumedScatters found = assumed_scatters(problem, runs, fit);
  ASSERT_THAT(found.readings, SizeIs(1));
  EXPECT_EQ(found.readings[0].observable, "roll");
  EXPECT_NEAR(found.readings[0].fraction, kAssumed, 1e-9);
  ASSERT_THAT(found.coefficients, SizeIs(problem.parameters.size()));
  const JointFit half = fit_jointly(of_unknown_rolls(kAssumed / 2), runs);
  const JointFit twice = fit_jointly(of_unknown_rolls(2 * kAssumed), runs);
  for (std::size_t j = 0; j < found.coefficients.size(); ++j) {
    EXPECT_NEAR(found.coefficients[j].half.interval.low, half.parameters[j].interval.low, 1e-6);
    EXPECT_NEAR(found.coefficients[j].twice.interval.high, twice.parameters[j].interval.high, 1e-6);
    EXPECT_EQ(found.coefficients[j].twice.verdict, twice.parameters[j].verdict);
  }
  const ScatterDependence& rolling = found.coefficients[2];
  EXPECT_LT(width_of(rolling.half.interval), .9 * width_of(fit.parameters[2].interval));
  EXPECT_GT(width_of(rolling.twice.interval), 1.1 * width_of(fit.parameters[2].interval));
  EXPECT_THAT(rolling.rests_on, ElementsAre("roll"));
  EXPECT_THAT(found.coefficients[1].rests_on, IsEmpty()) << "the tilt tells sliding friction";
}

TEST(AssumedScatter, IsNoLessThanChanceInTheSimulation) {
  const Problem problem = of_unknown_rolls(.001);
  const fake::Runs runs = fake::first_runs(problem);
  const JointFit fit = fit_jointly(problem, runs);
  const AssumedScatters found = assumed_scatters(problem, runs, fit);
  EXPECT_GT(found.readings.at(0).fraction, .1);
  for (std::size_t j = 0; j < found.coefficients.size(); ++j) {
    EXPECT_NEAR(found.coefficients[j].half.interval.low, fit.parameters[j].interval.low, 1e-6);
  }
}

TEST(AssumedScatter, IsSaidInTheVerdictThatRestsOnIt) {
  StudyResult result = test::joint_result();
  auto& joint = std::get<JointResult>(result.found);
  ResultParameter& sliding = joint.parameters[1];
  EXPECT_THAT(condition_text(joint, sliding), IsEmpty()) << "it is open anyway";
  sliding.verdict = Verdict::one_sided;
  EXPECT_EQ(condition_text(joint, sliding), "if single readings of roll scatter by 35 %");
  EXPECT_THAT(condition_text(joint, joint.parameters[0]), IsEmpty());
  EXPECT_EQ(systematic_text(joint.observables[0]),
            "± 0.28 mm (bias_sd 0.25, air_drag 0.12), which more readings do not lower");
}

}  // namespace
}  // namespace repose::calibrate
