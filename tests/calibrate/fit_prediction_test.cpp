#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "calibrate/fit/points.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::HasSubstr;

using fake::kTruth;

/// Everything measured at the truth, one experiment held out.
Problem holding_out(const std::string& experiment, std::uint64_t seed = 1) {
  Problem problem = fake::problem(kTruth, seed);
  for (const Observable& observable : problem.observables) {
    if (observable.experiment == experiment) problem.held_out.push_back(observable);
  }
  std::erase_if(problem.observables,
                [&](const Observable& observable) { return observable.experiment == experiment; });
  return problem;
}

JointFit fit_with(const std::vector<std::vector<double>>& drawn) {
  JointFit fit;
  fit.drawn = drawn;
  return fit;
}

/// A fit that knows the first coefficient within a standard deviation, the others exactly.
JointFit fit_of(const std::vector<double>& middle, double sd, Random& random) {
  std::vector<std::vector<double>> drawn(kDrawnSets, middle);
  for (std::vector<double>& values : drawn) values.front() += sd * random.normal();
  return fit_with(drawn);
}

Prediction predicted(const Problem& problem, const JointFit& fit) {
  return predictions_of(problem, fit, fake::run_all(prediction_jobs(problem, fit))).at(0);
}

TEST(Prediction, JobsAreOfWhatIsHeldOutAloneWithSeedsOfTheirOwn) {
  const Problem problem = holding_out("heap");
  Random random(1);
  const std::vector<Job> jobs = prediction_jobs(problem, fit_of(kTruth, .02, random));
  EXPECT_EQ(jobs.size(), kDrawnSets * kPredictionRepeats + kRangeRuns);
  std::set<std::uint64_t> taken;
  for (const Job& job : propose(problem, {})) taken.insert(job.seed);
  for (int set = 0; set < 12; ++set) {
    for (const Job& job : verification_jobs(problem, kTruth, 8, set)) taken.insert(job.seed);
  }
  for (const Job& job : jobs) {
    EXPECT_EQ(job.experiment, "heap");
    EXPECT_EQ(job.inputs.stiffness, 1);
    EXPECT_TRUE(taken.insert(job.seed).second);
  }
  EXPECT_TRUE(prediction_jobs(fake::problem(kTruth, 1), fit_of(kTruth, .02, random)).empty());
}

TEST(Prediction, IntervalsHoldTheReadingAsOftenAsTheySay) {
  constexpr int kMaterials = 400;
  constexpr double kSd = .03;
  int held = 0;
  for (std::uint64_t seed = 1; seed <= kMaterials; ++seed) {
    Random random(seed);
    std::vector<double> truth = kTruth;
    truth.front() += kSd * random.normal();  // as uncertain as the drawn ones
    Problem problem = holding_out("drop", seed);
    problem.settings.seed = 1000 * seed;
    const Prediction prediction = predicted(problem, fit_of(kTruth, kSd, random));
    const double reading = fake::expected("drop", "value", truth);
    held += prediction.interval.low <= reading && reading <= prediction.interval.high ? 1 : 0;
  }
  EXPECT_GE(held, .91 * kMaterials);
  EXPECT_LE(held, .99 * kMaterials);
}

TEST(Prediction, WhatTheCoefficientsLeaveOpenIsToldFromChance) {
  Random random(3);
  const Problem problem = holding_out("heap");
  const Prediction sure = predicted(problem, fit_of(kTruth, 0, random));
  EXPECT_GT(sure.run_sd, 0);
  EXPECT_LT(sure.coefficients_sd, sure.run_sd);
  const Prediction unsure = predicted(holding_out("drop"), fit_of(kTruth, .1, random));
  EXPECT_GT(unsure.coefficients_sd, unsure.run_sd);
  const double open2 = unsure.coefficients_sd * unsure.coefficients_sd;
  const double chance2 = unsure.run_sd * unsure.run_sd / kPredictionRepeats;
  EXPECT_NEAR(unsure.uncertainty * unsure.uncertainty,
              open2 + (open2 + chance2) / static_cast<double>(kDrawnSets), 1e-6 * open2);
}

TEST(Prediction, WithoutChanceThereIsOneRunOfEachSet) {
  const Problem problem = holding_out("tilt");
  const JointFit fit = fit_with(std::vector<std::vector<double>>(kDrawnSets, kTruth));
  EXPECT_EQ(prediction_jobs(problem, fit).size(), kDrawnSets + kRangeRuns);
  const Prediction prediction = predicted(problem, fit);
  EXPECT_EQ(prediction.uncertainty, 0);
  EXPECT_NEAR(prediction.predicted, fake::expected("tilt", "value", kTruth), 1e-9);
}

TEST(Prediction, TheRightCoefficientsAgreeAndOthersDisagree) {
  Problem problem = holding_out("drop");
  problem.held_out.front().tolerance = 5;
  Random random(5);
  EXPECT_EQ(predicted(problem, fit_of(kTruth, .001, random)).verdict, AgreementVerdict::agrees);
  std::vector<double> wrong = kTruth;
  wrong.front() = .6;
  EXPECT_EQ(predicted(problem, fit_of(wrong, .001, random)).verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(predicted(problem, fit_of(kTruth, .1, random)).verdict, AgreementVerdict::cannot_tell)
      << "nobody knows";
}

TEST(Prediction, WhatTheBoundsAllowIsToldAndSetsTheMargin) {
  const Problem problem = holding_out("tilt");
  const JointFit fit = fit_with(std::vector<std::vector<double>>(kDrawnSets, kTruth));
  const Prediction prediction = predicted(problem, fit);
  ASSERT_TRUE(prediction.possible);
  EXPECT_LT(prediction.possible->low, prediction.predicted - 5);
  EXPECT_GT(prediction.possible->high, prediction.predicted + 5);
  EXPECT_LE(prediction.tolerance, 2);
  // A plate that slides at the same angle whatever the grains.
  fake::Runs alike;
  for (const Job& job : prediction_jobs(problem, fit)) {
    alike.push_back({job, {{"value", problem.held_out.front().mean}}, ""});
  }
  const Prediction insensitive = predictions_of(problem, fit, alike).front();
  EXPECT_EQ(insensitive.tolerance_from, MarginSource::range);
  EXPECT_NE(insensitive.verdict, AgreementVerdict::agrees);
}

TEST(Prediction, CoefficientsThatNeverGiveAReadingDisagree) {
  const Problem problem = holding_out("heap");
  Random random(7);
  const JointFit fit = fit_of(kTruth, .01, random);
  fake::Runs runs;
  for (const Job& job : prediction_jobs(problem, fit)) {
    runs.push_back({.job = job, .readings = {}, .failure = "the grains stay in the tube"});
  }
  const Prediction never = predictions_of(problem, fit, runs).at(0);
  EXPECT_EQ(never.verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(never.failed_runs, static_cast<int>(runs.size() - kRangeRuns));
  EXPECT_FALSE(never.possible);
  EXPECT_TRUE(std::isnan(never.predicted));
  runs[0].readings = runs[2].readings = {{"value", 22}};
  runs[0].failure = runs[2].failure = "";
  const Prediction seldom = predictions_of(problem, fit, runs).at(0);
  EXPECT_EQ(seldom.sets, 2);
  EXPECT_EQ(seldom.verdict, AgreementVerdict::cannot_tell) << "two sets say nothing";
}

TEST(Prediction, ReadingsOfAFittedExperimentCannotBeHeldOut) {
  Problem problem = holding_out("heap");
  Observable also = problem.held_out.front();
  also.name = "heap again";
  problem.observables.push_back(also);
  EXPECT_THAT(error_of([&] { require_sound(problem); }),
              HasSubstr("held out, but other readings of heap are fitted"));
}

}  // namespace
}  // namespace repose::calibrate
