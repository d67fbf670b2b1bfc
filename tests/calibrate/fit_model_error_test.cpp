// Model error that remains whatever the coefficients are: known beforehand, and larger if readings
// that share a coefficient contradict each other.

#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/verification.h"
#include "calibrate/study/study_problem.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/tilt.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

constexpr double kNormal95 = 1.96;
constexpr int kReadings = 10'000;  // so that the standard deviation is known

/// Experiments without random scatter that read 10 + 20 x, the laboratory reading of each, with a
/// standard uncertainty of .1, and the model error of each.
struct MissedBench {
  std::vector<double> measured;
  std::vector<double> model_sd;
};

Problem problem_of(const MissedBench& bench) {
  Problem problem;
  problem.parameters = {{"friction", 0, 1, {}}};
  for (std::size_t k = 0; k < bench.measured.size(); ++k) {
    const std::string name = "line " + std::to_string(k);
    problem.experiments.push_back({name, {0}, 1, false, {"value"}});
    Observable observable;
    observable.name = observable.experiment = name;
    observable.unit = "mm";
    observable.mean = bench.measured[k];
    observable.sd = .1 * std::sqrt(double{kReadings});
    observable.n = kReadings;
    observable.model_sd = bench.model_sd[k];
    problem.observables.push_back(observable);
  }
  return problem;
}

JointFit fit_of(const Problem& problem) {
  constexpr int kRuns = 9;
  fake::Runs runs;
  for (const Experiment& experiment : problem.experiments) {
    for (int i = 0; i < kRuns; ++i) {
      const double x = i / (kRuns - 1.);
      runs.push_back({{experiment.name, {x}, 1}, {{"value", 10 + 20 * x}}, ""});
    }
  }
  return fit_jointly(problem, runs);
}

JointFit fit_of(const MissedBench& bench) { return fit_of(problem_of(bench)); }

double half_width(const JointFit& fit) {
  return (fit.parameters[0].interval.high - fit.parameters[0].interval.low) / 2;
}

TEST(ModelError, WidensAnIntervalBesideTheBenchsOwn) {
  EXPECT_NEAR(half_width(fit_of(MissedBench{{20}, {0}})), kNormal95 * .1 / 20, 2e-4);
  const JointFit fit = fit_of(MissedBench{{20}, {.3}});
  EXPECT_NEAR(half_width(fit), kNormal95 * std::hypot(.1, .3) / 20, 5e-4);
  EXPECT_EQ(fit.observables[0].measured_uncertainty, .1) << "which is the bench's alone";
  EXPECT_EQ(fit.observables[0].model_uncertainty, .3);
}

// One reading cannot contradict itself.
TEST(ModelError, StaysWhatWasSaidWhereNothingIsLeftToTellBy) {
  EXPECT_EQ(fit_of(MissedBench{{20}, {.3}}).model_error_scale, 1);
  EXPECT_EQ(fit_of(MissedBench{{20}, {0}}).model_error_scale, std::nullopt);
}

// The variance s^2 of two means of equal uncertainty that differ by x1 - x2 is estimated as (x1 -
// x2)^2 / 2 (Paule and Mandel 1982, equation 8, two laboratories): 22 - 18 gives s^2 = 8, of which
// .01 is that of the readings.
TEST(ModelError, IsAsLargeAsReadingsContradictEachOther) {
  const JointFit fit = fit_of(MissedBench{{18, 22}, {.5, .5}});
  ASSERT_TRUE(fit.model_error_scale);
  EXPECT_NEAR(*fit.model_error_scale, std::sqrt(8 - .01) / .5, .02);
  EXPECT_NEAR(half_width(fit), kNormal95 * std::sqrt(8. / 2) / 20, .005);
  EXPECT_NEAR(fit.observables[0].model_uncertainty, std::sqrt(8 - .01), .02);
  EXPECT_NEAR(fit.chi2, 8 / (.01 + .25), .1) << "by what was said, which is what does not fit";
}

TEST(ModelError, StaysWhatWasSaidWhereReadingsAgree) {
  EXPECT_EQ(fit_of(MissedBench{{19.8, 20.2}, {.5, .5}}).model_error_scale, 1);
}

// The reading with the larger stated model error gives way.
TEST(ModelError, IsSharedAsItWasSaid) {
  const JointFit fit = fit_of(MissedBench{{18, 22}, {.1, .5}});
  EXPECT_NEAR(fit.parameters[0].value, (18 - 10) / 20. + .2 / 26, .003);
}

TEST(ModelError, WithoutOneReadingsThatContradictEachOtherAreWarnedOf) {
  const JointFit fit = fit_of(MissedBench{{18, 22}, {0, 0}});
  EXPECT_EQ(fit.model_error_scale, std::nullopt);
  EXPECT_NEAR(fit.chi2, 8 / .01, 10);
  EXPECT_NEAR(half_width(fit), kNormal95 * .1 / std::sqrt(2.) / 20, 2e-4) << "as if it were right";
}

// Fits of a model that is worse than stated: its error is N(0, (2 d)^2).
TEST(ModelError, IntervalsHoldTheTruthOfAModelThatIsWorseThanWasSaid) {
  constexpr int kTrials = 150, kReadingsOfEach = 5;
  int held = 0;
  Random random(11);
  for (int trial = 0; trial < kTrials; ++trial) {
    MissedBench bench;
    for (int k = 0; k < kReadingsOfEach; ++k) {
      bench.measured.push_back(20 + .1 * random.normal() + .6 * random.normal());
      bench.model_sd.push_back(.3);
    }
    const Interval interval = fit_of(bench).parameters[0].interval;
    held += interval.low <= .5 && .5 <= interval.high ? 1 : 0;
  }
  // With the stated error alone it would be 1.96 .32 / .61 sigma: 69 %.
  EXPECT_GE(held, .85 * kTrials);
}

// More readings do not improve the model.
TEST(ModelError, IsWhatMoreReadingsLeave) {
  const std::optional<Narrowing> narrowing =
      fit_of(MissedBench{{20}, {.3}}).parameters[0].narrowing;
  ASSERT_TRUE(narrowing);
  EXPECT_NEAR(narrowing->readings, std::hypot(.05, .3) / std::hypot(.1, .3), .03);
}

fake::Runs check_runs(const Problem& problem, double reading) {
  fake::Runs runs;
  for (const Job& job : verification_jobs(problem, {.5}, 2, 0)) {
    runs.push_back({job, {{"value", reading}}, ""});
  }
  return runs;
}

// The same difference is less significant.
TEST(ModelError, MakesADifferenceLessOfASurpriseAndNoAgreement) {
  const auto check = [](double model_sd) {
    Problem problem = problem_of(MissedBench{{20}, {model_sd}});
    problem.observables[0].tolerance = .5;
    return verify(problem, {.5}, check_runs(problem, 20.8), nullptr, nullptr).observables[0];
  };
  EXPECT_EQ(check(0).verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(check(.8).verdict, AgreementVerdict::cannot_tell);
  EXPECT_NEAR(check(.8).chance, std::erfc(.8 / std::hypot(.1, .8) / std::sqrt(2.)), 1e-4);
  EXPECT_EQ(check(.8).difference.high, check(0).difference.high);
}

struct StudyModelError : ::testing::Test {
  Problem problem(const std::vector<std::string>& settings) {
    const dem::Study read =
        dem::read_study(folder_.write("study.toml", test::kSphereStudy), settings);
    return problem_of(read, dem::build_grain(read.grain), budget_named("quick")).problem;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(StudyModelError, IsAPercentageOfTheReading) {
  const Problem stated = problem(
      {"experiment.tilt.measured = { mean = 20 }", "experiment.tilt.model_error_percent = 4"});
  EXPECT_NEAR(stated.observables.at(1).model_sd, .8, 1e-12);
  EXPECT_NEAR(stated.experiments.at(1).model_fraction, .04, 1e-12);
  const Problem usual = problem({"experiment.tilt.measured = { mean = 20 }"});
  const double fraction = dem::experiment_of<dem::TiltProtocol>()->usual_model_error;
  EXPECT_NEAR(usual.observables.at(1).model_sd, fraction * 20, 1e-12);
}

TEST_F(StudyModelError, IsNoMoreThanTheReading) {
  EXPECT_ANY_THROW(problem({"experiment.tilt.model_error_percent = 101"}));
  EXPECT_ANY_THROW(problem({"experiment.tilt.model_error_percent = -1"}));
}

}  // namespace
}  // namespace repose::calibrate
