#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/advice.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/surrogate.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using ::testing::SizeIs;

constexpr double kHour_s = 3600;

fake::Runs runs_of_round(const Problem& problem) {
  return in_order(problem, fake::first_runs(problem));
}

/// The same jobs again, with different seeds.
fake::Runs twice(const fake::Runs& runs) {
  constexpr std::uint64_t kOtherSeeds = 500'000;
  std::vector<Job> jobs;
  for (const auto& run : runs) {
    jobs.push_back(run.job);
    jobs.back().seed += kOtherSeeds;
  }
  fake::Runs all = fake::run_all(jobs);
  all.insert(all.end(), runs.begin(), runs.end());
  return all;
}

std::vector<double> widths(const Problem& problem, const fake::Runs& runs) {
  std::vector<double> widths;
  for (const FittedParameter& parameter : fit_jointly(problem, runs).parameters) {
    widths.push_back(parameter.interval.high - parameter.interval.low);
  }
  return widths;
}

TEST(Narrowing, GoesFromNoneToThatOfAnExactSimulation) {
  const Problem problem = fake::problem();
  const Solution solution = solve(problem, runs_of_round(problem));
  const auto soon = narrowing_of(solution, kHour_s);
  const auto late = narrowing_of(solution, 1e9 * kHour_s);
  ASSERT_THAT(soon, SizeIs(fake::kTruth.size()));
  for (std::size_t j = 0; j < soon.size(); ++j) {
    EXPECT_NEAR(*late[j].hour, 1, 1e-6) << "an hour after ten thousand years";
    EXPECT_LE(soon[j].exact, *soon[j].hour);
    EXPECT_LT(*soon[j].hour, 1);
    EXPECT_LT(soon[j].readings, 1);
    EXPECT_GE(soon[j].exact, 0);
  }
}

TEST(Narrowing, MoreReadingsDoNotLowerWhatTheyHaveInCommon) {
  Problem problem = fake::problem();
  const fake::Runs runs = runs_of_round(problem);
  const auto before = narrowing_of(solve(problem, runs), kHour_s);
  for (Observable& observable : problem.observables) {
    observable.systematic_sd = 20 * standard_uncertainty(observable);
  }
  const auto after = narrowing_of(solve(problem, runs), kHour_s);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_LT(before[j].readings, .9) << j;
    EXPECT_GT(after[j].readings, .98) << j;
  }
}

TEST(Narrowing, ForeseesWhatMoreReadingsDo) {
  Problem problem = fake::problem();
  const fake::Runs runs = runs_of_round(problem);
  const auto foreseen = narrowing_of(solve(problem, runs), kHour_s);
  const std::vector<double> before = widths(problem, runs);
  for (Observable& observable : problem.observables) observable.n *= 4;
  const std::vector<double> after = widths(problem, runs);
  for (std::size_t j = 0; j < 3; ++j) {  // those of the wall: determined
    EXPECT_NEAR(after[j] / before[j], foreseen[j].readings, .15) << j;
  }
}

TEST(Narrowing, ForeseesWhatTwiceTheRunsDo) {
  const Problem problem = fake::problem();
  const fake::Runs runs = runs_of_round(problem);
  const auto foreseen = narrowing_of(solve(problem, runs), kHour_s);
  const std::vector<double> before = widths(problem, runs);
  const std::vector<double> after = widths(problem, twice(runs));
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(after[j] / before[j], *foreseen[j].hour, .2) << j;
  }
}

TEST(Narrowing, IsPartOfEveryFit) {
  const Problem problem = fake::problem();
  for (const FittedParameter& parameter : fit_jointly(problem, runs_of_round(problem)).parameters) {
    ASSERT_TRUE(parameter.narrowing);
    EXPECT_LT(parameter.narrowing->exact, 1);
  }
}

}  // namespace
}  // namespace repose::calibrate
