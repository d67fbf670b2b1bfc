#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using fake::kTruth;

TEST(Verification, JobsHaveSeedsOfTheirOwn) {
  const Problem problem = fake::problem();
  std::set<std::uint64_t> seeds;
  for (const Job& job : propose(problem, {})) seeds.insert(job.seed);
  const std::vector<Job> best = verification_jobs(problem, kTruth, 5, 0);
  const std::vector<Job> second = verification_jobs(problem, kTruth, 5, 1);
  const auto jobs_of = [&](const char* experiment) {
    return std::count_if(best.begin(), best.end(),
                         [&](const Job& job) { return job.experiment == experiment; });
  };
  EXPECT_EQ(jobs_of("heap"), 5);
  EXPECT_EQ(jobs_of("tilt"), 1) << "there is no chance in it";
  EXPECT_EQ(jobs_of("drop"), 30) << "they cost next to nothing";
  for (const Job& job : best) {
    EXPECT_TRUE(job.experiment == "tilt" || !seeds.contains(job.seed));
  }
  EXPECT_NE(best.front().seed, second.front().seed);
}

TEST(Verification, TheTruthIsCalledWrongAsRarelyAsItShould) {
  int wrong = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Problem problem = fake::problem(kTruth, seed);
    const Verification check =
        verify(problem, kTruth, fake::run_all(verification_jobs(problem, kTruth, 8, 0)));
    wrong += check.verdict == AgreementVerdict::disagrees;
  }
  EXPECT_LE(wrong, 19);  // 10 +- 3 expected
  EXPECT_GT(wrong, 0);
}

TEST(Verification, GivesBothMeansWithTheirUncertainties) {
  const Problem problem = fake::problem();
  const Verification result =
      verify(problem, kTruth, fake::run_all(verification_jobs(problem, kTruth, 8, 0)));
  ASSERT_EQ(result.observables.size(), 4);
  EXPECT_EQ(result.observables[0].runs, 30);
  EXPECT_EQ(result.observables[1].simulated_uncertainty, 0);
  EXPECT_NEAR(result.observables[3].simulated, 22.5, 1);
}

TEST(Verification, AFewRepeatsThatHappenToAgreeAreNotTrustedOverTheFit) {
  const Problem problem = fake::problem();
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
  EXPECT_NEAR(result.observables[3].simulated_uncertainty, 1000 / std::sqrt(2.), 1e-9);
  EXPECT_EQ(result.observables[1].simulated_uncertainty, 0) << "the plate knows no chance";
  EXPECT_EQ(result.observables[0].measured_uncertainty, 7);
  EXPECT_LT(std::abs(result.observables[3].difference_sigma), .1);
}

TEST(Verification, AnotherMaterialDoesNot) {
  const Problem problem = fake::problem();
  std::vector<double> other = kTruth;
  other[5] = .15;
  const Verification result =
      verify(problem, other, fake::run_all(verification_jobs(problem, other, 8, 0)));
  EXPECT_EQ(result.verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(result.observables[3].verdict, AgreementVerdict::disagrees);
  EXPECT_GT(result.observables[3].difference_sigma, 3);
}

TEST(Verification, OnlyFreshRunsAtTheSetCount) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 3, 0));
  auto used = runs.front();
  used.job.seed = 1;
  used.readings["value"] = 1e6;
  runs.push_back(used);
  EXPECT_EQ(verify(problem, kTruth, runs).observables[0].runs, 30);
}

TEST(Verification, StifferRunsThanTheStudysDoNotCount) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 3, 0));
  const Verification check = verify(problem, kTruth, runs);
  const fake::Runs own = runs;
  for (auto run : own) {
    run.job.inputs.stiffness = 10;
    run.readings["value"] = 1e6;
    runs.push_back(run);
  }
  EXPECT_EQ(verify(problem, kTruth, runs).observables[3].simulated, check.observables[3].simulated);
  EXPECT_EQ(verify(problem, kTruth, runs).observables[3].runs, 3);
}

TEST(Verification, ASetThatGivesNoReadingDisagrees) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 3, 0));
  for (auto& run : runs) {
    if (run.job.experiment == "heap") run = {run.job, {}, "the grains stay in the tube"};
  }
  const Verification result = verify(problem, kTruth, runs);
  EXPECT_EQ(result.verdict, AgreementVerdict::disagrees);
  EXPECT_TRUE(std::isnan(result.observables[3].difference_sigma));
  EXPECT_EQ(result.observables[3].failed_runs, 3);
}

/// A fit as certain as the bench that predicts the true readings, the heap's shifted by `off`.
JointFit fit_that_expects(const Problem& problem, double off) {
  JointFit fit;
  for (const double value : kTruth) fit.parameters.emplace_back().value = value;
  fit.surrogates.resize(problem.observables.size());
  for (const Observable& observable : problem.observables) {
    FittedObservable& fitted = fit.observables.emplace_back();
    fitted.name = observable.name;
    fitted.measured_uncertainty = standard_uncertainty(observable);
    fitted.simulated = fake::expected(observable.experiment, "value", kTruth);
    fitted.simulated_uncertainty = .2 * fitted.measured_uncertainty;
  }
  for (SurrogateQuality& quality : fit.surrogates) quality.runs = 40;
  fit.observables[3].simulated += off;
  return fit;
}

TEST(SurrogateCheck, TellsWhoMissedItsOwnCheck) {
  int wrongly = 0;
  int found = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Problem problem = fake::problem(kTruth, seed);
    const fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 8, 0));
    const auto any = [](const std::vector<SurrogateCheck>& checks) {
      return std::any_of(checks.begin(), checks.end(),
                         [](const SurrogateCheck& check) { return check.misses; });
    };
    wrongly += any(check_surrogates(problem, fit_that_expects(problem, 0), runs));
    found += check_surrogates(problem, fit_that_expects(problem, 3), runs)[3].misses;
  }
  EXPECT_LE(wrongly, 12);  // 5 expected, slightly more because rolling distances are skewed
  EXPECT_EQ(found, 100) << "three degrees";
}

TEST(SurrogateCheck, AMissThatTheBenchCouldNotSeeIsNone) {
  const Problem problem = fake::problem();
  const fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 8, 0));
  JointFit fit = fit_that_expects(problem, 0);
  fit.observables[1].simulated += .3 * fit.observables[1].measured_uncertainty;
  fit.observables[1].simulated_uncertainty = 1e-6;
  const SurrogateCheck plate = check_surrogates(problem, fit, runs)[1];
  EXPECT_LT(plate.chance, 1e-6);
  EXPECT_FALSE(plate.misses);
}

TEST(Verification, RefusesWhatCannotBeChecked) {
  const Problem problem = fake::problem();
  EXPECT_THROW(verification_jobs(problem, {.1}, 5, 0), base::InputError);
  EXPECT_THROW(verification_jobs(problem, kTruth, 1, 0), base::InputError);
  EXPECT_THROW(verification_jobs(problem, kTruth, 5, -1), base::InputError);
}

}  // namespace
}  // namespace repose::calibrate
