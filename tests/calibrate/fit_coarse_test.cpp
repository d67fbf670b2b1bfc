// Coarse runs: cheaper runs with larger grains, corrected by full runs at nearby places.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/best_places.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/gaussian_process.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;

constexpr double kCoarseShift = 1.5;

double full_curve(const Point& x) { return 3 * std::sin(3 * x[0]) + x[1]; }

/// Values of full_curve: full runs first, then coarse ones, off by a shift of slope `lean`.
struct TwoKinds {
  std::vector<Point> places;
  std::vector<double> values;
  std::vector<RunKind> kinds;

  GaussianProcess process() const { return {places, values, true, {}, 2, {}, kinds}; }
};

TwoKinds two_kinds(std::size_t full, std::size_t coarse, double lean, std::uint64_t seed = 3) {
  TwoKinds data;
  Random random(seed);
  for (std::size_t i = 0; i < full + coarse; ++i) {
    const bool is_coarse = i >= full;
    const Point place = sequence_point(is_coarse ? i - full : i, 2);
    const double shift = is_coarse ? kCoarseShift + lean * (place[0] - .5) : 0;
    data.places.push_back(place);
    data.values.push_back(full_curve(place) + shift + (is_coarse ? .2 : .1) * random.normal());
    data.kinds.push_back(is_coarse ? RunKind::coarse : RunKind::full);
  }
  return data;
}

TEST(CoarseValues, TheirShiftIsFoundFromPairs) {
  const GaussianProcess process = two_kinds(6, 30, 0).process();
  const Expectation shift = process.coarse_shift({.4, .6});
  EXPECT_NEAR(shift.mean, kCoarseShift, 2.5 * std::sqrt(shift.variance));
  EXPECT_LT(std::sqrt(shift.variance), .25);
  EXPECT_NEAR(process.noise_sd(RunKind::coarse), .2, .1);
}

TEST(CoarseValues, WhatIsExpectedIsTheFullFunction) {
  int within = 0;
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const GaussianProcess process = two_kinds(6, 30, 1, seed).process();
    for (const Point& place : {Point{.2, .3}, Point{.5, .7}, Point{.8, .4}}) {
      const Expectation at = process.at(place, false);
      within += std::abs(at.mean - full_curve(place)) < 1.96 * std::sqrt(at.variance) ? 1 : 0;
      ++tried;
    }
  }
  // Of 30 intervals of 95 %, 26 to 30 hold in 98.6 % of trials; those of one seed are correlated.
  EXPECT_THAT(within, AllOf(Ge(25), Le(tried)));
}

TEST(CoarseValues, TeachMoreThanTheFewFullOnesAlone) {
  const TwoKinds both = two_kinds(6, 30, 0);
  TwoKinds few = both;
  few.places.resize(6);
  few.values.resize(6);
  few.kinds.resize(6);
  const Point place = {.62, .31};
  const double with = both.process().at(place, false).variance;
  EXPECT_LT(with, .5 * few.process().at(place, false).variance);
}

TEST(CoarseValues, NeverKnowMoreThanTheirShiftIsKnown) {
  const GaussianProcess process = two_kinds(2, 200, 0).process();
  const Point place = {.45, .55};
  // With so many coarse runs the sum of curve and shift is known; only its split remains uncertain.
  EXPECT_NEAR(process.at(place, false).variance, process.coarse_shift(place).variance,
              .3 * process.coarse_shift(place).variance);
}

TEST(CoarseValues, CovariancesAreThoseThatLeavingOneOutTells) {
  const TwoKinds data = two_kinds(6, 20, 0);
  const GaussianProcess process = data.process();
  const LeaveOneOut last = process.leave_one_out().back();
  const double noise2 = std::pow(process.noise_sd(RunKind::coarse), 2);
  const double with = process.covariance({data.places.back()}, {RunKind::coarse})[0];
  const double without = 1 / (1 / with - 1 / noise2);
  EXPECT_NEAR(last.sd * last.sd, without + noise2, 1e-6 * last.sd);
}

TEST(CoarseValues, GradientsAreThoseOfWhatIsExpected) {
  const GaussianProcess process = two_kinds(6, 20, 1).process();
  const Point here = {.4, .3};
  const Expectation at = process.at(here, true);
  for (std::size_t c = 0; c < here.size(); ++c) {
    constexpr double kStep = 1e-5;
    Point up = here, down = here;
    up[c] += kStep;
    down[c] -= kStep;
    const double slope = (process.at(up, false).mean - process.at(down, false).mean) / (2 * kStep);
    EXPECT_NEAR(at.mean_gradient[c], slope, 1e-5) << c;
  }
}

/// Coarse runs everywhere, and `full` full runs.
Surrogate surrogate_of_kinds(std::size_t full) {
  const TwoKinds data = two_kinds(full, 40, 0);
  TrainingSet training_set{{0, 1}, true, data.places, data.values};
  training_set.kinds = data.kinds;
  return {training_set, {}, false};
}

std::vector<Point> coarse_candidates() {
  std::vector<Point> points;
  for (std::size_t i = 0; i < 25; ++i) points.push_back(sequence_point(i, 2));
  return points;
}

std::size_t full_among(const std::vector<ChosenRun>& runs) {
  return static_cast<std::size_t>(std::ranges::count(runs, RunKind::full, &ChosenRun::kind));
}

TEST(BestRuns, AreFullOnesWhereTheShiftIsWhatIsUnknown) {
  const auto runs =
      best_runs({surrogate_of_kinds(2)}, {1}, coarse_candidates(), {20, 1}, 100, 1000);
  EXPECT_THAT(full_among(runs), Ge(2U));
}

TEST(BestRuns, AreCoarseOnesWhereFullOnesCostTooMuch) {
  const auto runs = best_runs({surrogate_of_kinds(8)}, {1}, coarse_candidates(), {1e4, 1}, 12, 1e5);
  EXPECT_EQ(full_among(runs), 0);
  EXPECT_EQ(runs.size(), 12);
}

TEST(BestRuns, NeverCostMoreThanThereIs) {
  const auto runs = best_runs({surrogate_of_kinds(2)}, {1}, coarse_candidates(), {20, 1}, 10, 15);
  EXPECT_EQ(full_among(runs), 0);
}

Problem coarse_problem(std::uint64_t seed = 1) {
  Problem problem = fake::problem(fake::kTruth, seed);
  fake::coarsen(problem, 2.5);
  return problem;
}

std::vector<Job> heap_jobs(const std::vector<Job>& jobs, bool coarse) {
  std::vector<Job> heaps;
  std::ranges::copy_if(jobs, std::back_inserter(heaps), [&](const Job& job) {
    return job.experiment == "heap" && (job.inputs.size != 1) == coarse;
  });
  return heaps;
}

TEST(CoarseRuns, TheFirstRoundHasNoFullOnes) {
  const Problem problem = coarse_problem();
  std::vector<Job> jobs;
  for (const auto& run : fake::first_runs(problem)) jobs.push_back(run.job);
  EXPECT_THAT(heap_jobs(jobs, false), IsEmpty());
  EXPECT_THAT(heap_jobs(jobs, true).size(), Ge(14U)) << "2 for each coefficient, and 2 more";
}

/// The first round, and `full` full heaps at the truth.
fake::Runs first_and_checked(const Problem& problem, int full) {
  fake::Runs runs = fake::first_runs(problem);
  for (const Job& job : verification_jobs(problem, fake::kTruth, full, 0)) {
    if (job.experiment == "heap") runs.push_back(fake::run(job));
  }
  return runs;
}

TEST(StudiesOfCoarseRuns, HaveFullOnesWhereTheyAreWorthTheirTime) {
  Problem problem = coarse_problem();
  std::vector<Job> jobs;
  for (const auto& run : fake::study(problem)) jobs.push_back(run.job);
  EXPECT_THAT(heap_jobs(jobs, false), Not(IsEmpty()));
  fake::experiment_of(problem, "heap").run_s = 2 * problem.settings.budget_s;
  jobs.clear();
  for (const auto& run : fake::study(problem)) jobs.push_back(run.job);
  EXPECT_THAT(heap_jobs(jobs, false), IsEmpty());
}

TEST(CoarseRuns, WithoutFullOnesTheirShiftIsUnknownAndFullOnesTellIt) {
  const Problem problem = coarse_problem();
  const auto shift_with = [&](int full) {
    const fake::Runs runs =
        full == 0 ? fake::first_runs(problem) : first_and_checked(problem, full);
    return *fit_jointly(problem, runs).surrogates.back().coarse;
  };
  const CoarseQuality none = shift_with(0), some = shift_with(4);
  EXPECT_LT(std::abs(none.shift), none.uncertainty);
  EXPECT_GT(none.uncertainty, 1.5) << "of readings that scatter by 5 degrees";
  EXPECT_LT(some.uncertainty, .7 * none.uncertainty);
}

TEST(CoarseRuns, FullOnesAreThoseOfTheirOwnSizeWhicheverThatIs) {
  Problem problem = coarse_problem();
  fake::Runs runs = first_and_checked(problem, 2);
  fake::experiment_of(problem, "heap").full = {.size = 1.3};
  const fake::Runs checks = first_and_checked(problem, 3);
  runs.insert(runs.end(), checks.end() - 3, checks.end());
  EXPECT_EQ(checks.back().job.inputs.size, 1.3);
  const JointFit fit = fit_jointly(problem, runs);
  EXPECT_EQ(fit.surrogates.back().full_runs(), 3) << "heaps of the study's own are no part of it";
  EXPECT_EQ(fit.surrogates.back().full_size, 1.3);
  EXPECT_EQ(check_sample(problem, fake::kTruth, problem.observables.back(), runs).count(), 3);
}

double heap_seconds(const Problem& problem, const fake::Runs& runs) {
  double seconds = 0;
  for (const auto& run : runs) {
    if (run.job.experiment != "heap") continue;
    seconds += run_s_of(experiment_named(problem, "heap"), run.job.inputs);
  }
  return seconds;
}

TEST(StudiesOfCoarseRuns, FindTheSameWithFewerSeconds) {
  Problem cheap = coarse_problem();
  Problem dear = fake::problem();
  cheap.settings.budget_s = 400;
  const fake::Runs runs = fake::study(cheap), all = fake::study(dear);
  EXPECT_LT(heap_seconds(cheap, runs), .5 * heap_seconds(dear, all));
  const JointFit fit = fit_jointly(cheap, runs), reference = fit_jointly(dear, all);
  for (std::size_t j = 3; j < fit.parameters.size(); ++j) {
    const Interval& one = fit.parameters[j].interval;
    const Interval& other = reference.parameters[j].interval;
    EXPECT_LT(one.low, other.high) << fit.parameters[j].name;
    EXPECT_GT(one.high, other.low) << fit.parameters[j].name;
    EXPECT_THAT(fake::kTruth[j], AllOf(Ge(one.low), Le(one.high))) << fit.parameters[j].name;
  }
}

TEST(CoarseRuns, TheScatterOfFullOnesIsKnownByTheseAlone) {
  const Problem problem = coarse_problem();
  const fake::Runs runs = first_and_checked(problem, 3);
  const SurrogateQuality quality = fit_jointly(problem, runs).surrogates.back();
  EXPECT_EQ(quality.observable, "heap");
  EXPECT_EQ(quality.scatter_df(), 2);
}

TEST(CoarseRuns, OneFullRunThatFailsStopsNothing) {
  const Problem problem = coarse_problem();
  fake::Runs runs = first_and_checked(problem, 2);
  const auto full = std::ranges::find_if(runs, [](const auto& run) {
    return run.job.experiment == "heap" && run.job.inputs.size == 1;
  });
  full->readings.clear();
  full->failure = "the grains stay in the tube";
  const SurrogateQuality quality = fit_jointly(problem, runs).surrogates.back();
  EXPECT_EQ(quality.full_runs(), 1);
  EXPECT_EQ(quality.failed_runs, 1);
  EXPECT_GT(quality.coarse->uncertainty, 0);
}

TEST(CoarseRuns, RunsOfOtherInputsTeachNothing) {
  const Problem problem = coarse_problem();
  fake::Runs runs = fake::first_runs(problem);
  const Experiment& heap = experiment_named(problem, "heap");
  const std::size_t before =
      training_set_of(problem, heap, "value", in_order(problem, runs)).readings.size();
  Job stiffer = heap_jobs({runs.back().job}, true).front();
  stiffer.inputs = {.stiffness = 10};
  runs.push_back(fake::run(stiffer));
  EXPECT_EQ(training_set_of(problem, heap, "value", in_order(problem, runs)).readings.size(),
            before);
}

TEST(CoarseRuns, OneThatFailsSaysNothingOfFullOnes) {
  const Problem problem = coarse_problem();
  fake::Runs runs = fake::first_runs(problem);
  for (auto& run : runs) {
    if (run.job.inputs.size == 1) continue;
    run.readings.clear();
    run.failure = "no heap";
  }
  const Attempts attempts =
      attempts_of(problem, experiment_named(problem, "heap"), in_order(problem, runs));
  EXPECT_EQ(attempts.failures(), 0);
  EXPECT_THAT(attempts.failed, Each(false));
}

TEST(CoarseRuns, ThoseThatFailAreCountedByThemselves) {
  const Problem problem = coarse_problem();
  fake::Runs runs = fake::first_runs(problem);
  int failing = 2;
  for (auto& run : runs) {
    if (run.job.inputs.size == 1 || failing-- <= 0) continue;
    run.readings.clear();
    run.failure = "no heap";
  }
  int seen = 0;
  for (const SurrogateQuality& surrogate : fit_jointly(problem, runs).surrogates) {
    EXPECT_EQ(surrogate.failed_runs, 0) << surrogate.observable;
    if (!surrogate.coarse) continue;
    EXPECT_EQ(surrogate.coarse->failed_runs, 2) << surrogate.observable;
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace repose::calibrate
