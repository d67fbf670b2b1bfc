#include <cmath>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

#include "calibrate/fit/propose.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

const std::vector<double> kTruth = {.31, .42, .05, .2, .3, .06};

Problem quick() { return fake::problem(kTruth, 1); }

TEST(Verification, JobsHaveSeedsOfTheirOwn) {
  const Problem problem = quick();
  std::set<std::uint64_t> seeds;
  for (const Job& job : propose(problem, {})) seeds.insert(job.seed);
  const std::vector<Job> best = verification_jobs(problem, kTruth, 5, 0);
  const std::vector<Job> second = verification_jobs(problem, kTruth, 5, 1);
  EXPECT_EQ(best.size(), 16);  // the tilting plate once
  for (const Job& job : best) {
    EXPECT_TRUE(job.experiment == "tilt" || !seeds.contains(job.seed));
  }
  EXPECT_NE(best.front().seed, second.front().seed);
}

TEST(Verification, TheTruthAgreesAsOftenAsItShould) {
  int agreed = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Problem problem = fake::problem(kTruth, seed);
    agreed +=
        verify(problem, kTruth, fake::run_all(verification_jobs(problem, kTruth, 8, 0))).agrees;
  }
  EXPECT_GE(agreed, 182);  // 190 +- 3 expected
  EXPECT_LT(agreed, 200);
}

TEST(Verification, GivesBothMeansWithTheirUncertainties) {
  const Problem problem = quick();
  const Verification result =
      verify(problem, kTruth, fake::run_all(verification_jobs(problem, kTruth, 8, 0)));
  ASSERT_EQ(result.observables.size(), 4);
  EXPECT_EQ(result.observables[0].runs, 8);
  EXPECT_EQ(result.observables[1].simulated_uncertainty, 0);
  EXPECT_NEAR(result.observables[3].simulated, 22.5, 1);
}

TEST(Verification, AFewRepeatsThatHappenToAgreeAreNotTrustedOverTheFit) {
  const Problem problem = quick();
  const fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 2, 0));
  JointFit fit;
  fit.observables.resize(problem.observables.size());
  fit.surrogates.resize(problem.observables.size());
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    fit.observables[i].simulated_sd = 1000;
    fit.observables[i].measured_uncertainty = 7;
    fit.surrogates[i].runs = 40;
  }
  const Verification result = verify(problem, kTruth, runs, &fit);
  EXPECT_NEAR(result.observables[0].simulated_uncertainty, 1000 / std::sqrt(2.), 1e-9);
  EXPECT_EQ(result.observables[1].simulated_uncertainty, 0) << "the plate knows no chance";
  EXPECT_EQ(result.observables[0].measured_uncertainty, 7);
  EXPECT_LT(std::abs(result.observables[0].difference_sigma), .1);
}

TEST(Verification, AnotherMaterialDoesNot) {
  const Problem problem = quick();
  std::vector<double> other = kTruth;
  other[5] = .15;
  const Verification result =
      verify(problem, other, fake::run_all(verification_jobs(problem, other, 8, 0)));
  EXPECT_FALSE(result.agrees);
  EXPECT_GT(result.observables[3].difference_sigma, 3);
}

TEST(Verification, OnlyFreshRunsAtTheSetCount) {
  const Problem problem = quick();
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 3, 0));
  auto used = runs.front();
  used.job.seed = 1;
  used.readings["value"] = 1e6;
  runs.push_back(used);
  EXPECT_EQ(verify(problem, kTruth, runs).observables[0].runs, 3);
}

TEST(Verification, WithoutReadingsNothingAgrees) {
  const Problem problem = quick();
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 3, 0));
  for (auto& run : runs) {
    if (run.job.experiment == "heap") run = {run.job, {}, "the grains stay in the tube"};
  }
  const Verification result = verify(problem, kTruth, runs);
  EXPECT_FALSE(result.agrees);
  EXPECT_TRUE(std::isnan(result.observables[3].difference_sigma));
  EXPECT_EQ(result.observables[3].failed_runs, 3);
}

TEST(Verification, RefusesWhatCannotBeChecked) {
  const Problem problem = quick();
  EXPECT_THROW(verification_jobs(problem, {.1}, 5, 0), std::invalid_argument);
  EXPECT_THROW(verification_jobs(problem, kTruth, 1, 0), std::invalid_argument);
  EXPECT_THROW(verification_jobs(problem, kTruth, 5, -1), std::invalid_argument);
}

}  // namespace
}  // namespace repose::calibrate
