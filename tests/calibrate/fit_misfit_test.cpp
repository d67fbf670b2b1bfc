#include <cmath>
#include <numeric>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::HasSubstr;

using fake::kTruth;

/// With prior, failures and everything else.
Problem full_problem(bool robust) {
  Problem problem = fake::problem(kTruth, 1);
  problem.parameters[3].prior = Prior{.2, .05};
  problem.settings.robust = robust;
  return problem;
}

Misfit misfit_of(const Problem& problem, bool jams) {
  return {problem, in_order(problem, fake::run_all(first_round(problem), jams)), {}, false};
}

TEST(Misfit, DerivativesAreThoseOfItsValues) {
  for (const bool robust : {false, true}) {
    const Misfit misfit = misfit_of(full_problem(robust), true);
    const Point here = {.5, .3, .4, .6, .8, .7};  // close to where heaps jam
    const Residuals all = misfit.residuals(here, true);
    for (std::size_t j = 0; j < here.size(); ++j) {
      constexpr double kStep = 1e-5;
      Point up = here;
      Point down = here;
      up[j] += kStep;
      down[j] -= kStep;
      const std::vector<double> above = misfit.residuals(up, false).values;
      const std::vector<double> below = misfit.residuals(down, false).values;
      for (std::size_t i = 0; i < all.values.size(); ++i) {
        const double slope = (above[i] - below[i]) / (2 * kStep);
        EXPECT_NEAR(all.jacobian[i][j], slope, 2e-3 * std::max(1., std::abs(slope)))
            << "residual " << i << ", coordinate " << j << ", robust " << robust;
      }
    }
  }
}

/// The base radius, which partly repeats the angle, is measured on five of the heaps.
Problem with_radius(const Problem& problem) {
  Problem more = problem;
  more.observables.push_back(
      {"heap.base_radius_mm", "heap", "base_radius_mm", "mm", 100, 3, 5, {}});
  return more;
}

/// Heaps whose radius follows the random scatter of their angle.
fake::Runs heaps_of_one_volume(const Problem& problem) {
  fake::Runs runs = fake::run_all(first_round(problem));
  for (auto& run : runs) {
    const auto angle = run.readings.find("value");
    if (run.job.experiment != "heap") continue;
    const double chance = angle->second - fake::expected("heap", "value", run.job.values);
    run.readings["base_radius_mm"] =
        fake::expected("heap", "base_radius_mm", run.job.values) - 2 * chance;
  }
  return runs;
}

TEST(Misfit, DerivativesOfReadingsThatVaryTogetherAreThoseOfTheirValues) {
  Problem problem = with_radius(full_problem(false));
  problem.settings.budget_s = 3000;
  const Misfit misfit(problem, in_order(problem, heaps_of_one_volume(problem)), {}, false);
  ASSERT_LT(misfit.reading_correlation()[3][4], -.4);
  const Point here = {.5, .3, .4, .6, .8, .7};
  const Residuals all = misfit.residuals(here, true);
  for (std::size_t j = 0; j < here.size(); ++j) {
    constexpr double kStep = 1e-5;
    Point up = here;
    Point down = here;
    up[j] += kStep;
    down[j] -= kStep;
    for (const std::size_t i : {3U, 4U}) {
      const double slope =
          (misfit.residuals(up, false).values[i] - misfit.residuals(down, false).values[i]) /
          (2 * kStep);
      EXPECT_NEAR(all.jacobian[i][j], slope, 2e-3 * std::max(1., std::abs(slope)));
    }
  }
}

TEST(ReadingCorrelation, IsSeenInTheRunsAndOnlyWithinAnExperiment) {
  Problem problem = with_radius(full_problem(false));
  problem.settings.budget_s = 3000;
  const Misfit together(problem, in_order(problem, heaps_of_one_volume(problem)), {}, false);
  EXPECT_LT(together.reading_correlation()[3][4], -.6);
  EXPECT_EQ(together.reading_correlation()[4][3], together.reading_correlation()[3][4]);
  EXPECT_EQ(together.reading_correlation()[0][3], 0);
  const Misfit apart(problem, in_order(problem, fake::run_all(first_round(problem))), {}, false);
  EXPECT_LT(std::abs(apart.reading_correlation()[3][4]), .3);
}

TEST(ReadingCorrelation, IsNoneOfAReadingThatTheBenchReadsInTrialsOfItsOwn) {
  Problem problem = with_radius(full_problem(false));
  problem.settings.budget_s = 3000;
  problem.observables[4].has_own_trials = true;
  const Misfit misfit(problem, in_order(problem, heaps_of_one_volume(problem)), {}, false);
  EXPECT_EQ(misfit.reading_correlation()[3][4], 0);
  EXPECT_EQ(misfit.reading_correlation()[4][3], 0);
}

TEST(ReadingCorrelation, WhatACurveDoesNotFollowIsNoChance) {
  // Both readings vary with the place in a way that no curve through so few runs can follow.
  Problem problem = with_radius(full_problem(false));
  problem.settings.budget_s = 3000;
  fake::Runs runs = fake::run_all(first_round(problem));
  for (auto& run : runs) {
    if (run.job.experiment != "heap") continue;
    const double wiggle = 8 * std::sin(97 * run.job.values[3] + 61 * run.job.values[4]);
    run.readings["value"] += wiggle;
    run.readings["base_radius_mm"] -= 2 * wiggle;
  }
  const Misfit misfit(problem, in_order(problem, runs), {}, false);
  EXPECT_LT(std::abs(misfit.reading_correlation()[3][4]), .3);
}

TEST(ReadingCorrelation, ABenchSharesWhatTheSimulationExplains) {
  Problem problem = with_radius(full_problem(false));
  problem.settings.budget_s = 3000;
  const auto bench_with = [&](double sd_deg) {
    problem.observables[3].sd = sd_deg;
    const Misfit misfit(problem, in_order(problem, heaps_of_one_volume(problem)), {}, false);
    EXPECT_LT(misfit.reading_correlation()[3][4], -.6);
    return misfit.bench_correlation()[3][4];
  };
  const double much = bench_with(20);
  EXPECT_NEAR(bench_with(40) / much, .5, 1e-9);
  EXPECT_LT(std::abs(much), .3) << "an eye that reads within 20 degrees hides it";
  EXPECT_LT(bench_with(.01), 3 * much);
}

TEST(ReadingCorrelation, WhatTwoReadingsShareCountsOnce) {
  // Both 2 sigma off: if alike in sign and almost one reading, hardly more than one of them off.
  const std::vector<CorrelatedPart> parts = {{2, 1, 0, 10, {}, {}}, {2, 1, 0, 10, {}, {}}};
  const auto chi2 = [&](double correlation) {
    const Residuals r =
        made_independent(parts, {{{1, correlation}, {correlation, 1}}, {{1, 0}, {0, 1}}}, false);
    return r.values[0] * r.values[0] + r.values[1] * r.values[1];
  };
  EXPECT_NEAR(chi2(0), 8, 1e-9);
  EXPECT_NEAR(chi2(.9), 8 / 1.9, 1e-9);
  EXPECT_NEAR(chi2(-.9), 8 / .1, 1e-9) << "chance would have moved them apart";
  EXPECT_NEAR(shared_readings(5, 10), std::sqrt(.5), 1e-12);
}

TEST(ReadingCorrelation, AReadingAloneIsTheSameWithAndWithoutDerivatives) {
  const std::vector<CorrelatedPart> alone = {{.7, .3, .11, 7, {.2}, {.05}}};
  const Residuals with = made_independent(alone, {{{1}}, {{1}}}, true);
  EXPECT_EQ(made_independent(alone, {{{1}}, {{1}}}, false).values, with.values);
  EXPECT_NEAR(with.values[0], .7 / std::sqrt(.3 * .3 + .11), 1e-15);
}

TEST(Misfit, WhatReadingsHaveInCommonIsPartOfTheirMeansUncertainty) {
  Problem problem = full_problem(false);
  const Misfit before = misfit_of(problem, false);
  problem.observables[0].systematic_sd = 3 * before.measured_uncertainty(0);
  const Misfit after = misfit_of(problem, false);
  EXPECT_NEAR(after.measured_uncertainty(0) / before.measured_uncertainty(0), std::sqrt(10), 1e-9);
  EXPECT_EQ(before.lasting_variance(0), 0);
  EXPECT_NEAR(1 / after.weight(0) - 1 / before.weight(0), after.lasting_variance(0),
              1e-9 / after.weight(0));
  EXPECT_EQ(after.weight(1), before.weight(1));
}

TEST(Misfit, AReadingOfOneGrainScattersMoreThanTheMeanOfTen) {
  Problem problem = full_problem(false);
  problem.observables[0].sd.reset();
  problem.observables[0].assumed_sd_fraction = .001;  // less than the random scatter
  const double one = misfit_of(problem, false).measured_uncertainty(0);
  problem.experiments[0].readings_per_run = 10;
  const double ten = misfit_of(problem, false).measured_uncertainty(0);
  EXPECT_NEAR(ten / one, std::sqrt(10), 1e-9);
  // 20 % log-normal scatter from run to run, ten laboratory readings.
  EXPECT_NEAR(one, .2 * problem.observables[0].mean / std::sqrt(10), .3 * one);
}

TEST(Misfit, AReadingFromOneSideScattersMoreThanARunSeenFromMany) {
  Problem problem = full_problem(false);
  const std::size_t heap = 3;
  ASSERT_EQ(problem.observables[heap].name, "heap");
  problem.observables[heap].sd.reset();
  problem.observables[heap].assumed_sd_fraction = .001;  // less than the random scatter
  fake::Runs runs = fake::run_all(first_round(problem));
  for (auto& run : runs) {
    if (run.job.experiment == "heap") run.readings["within"] = run.job.seed % 2 == 0 ? 1 : 7;
  }
  const auto sd_of_one = [&] {
    return Misfit(problem, in_order(problem, runs), {}, false).measured_uncertainty(heap) *
           std::sqrt(problem.observables[heap].n);
  };
  const double seen_from_many = sd_of_one();
  problem.experiments[heap].scatter_within = "within";
  const double within = 5;  // root mean square of equal numbers of 1 and 7
  EXPECT_NEAR(sd_of_one(), std::hypot(seen_from_many, within), .2);
}

TEST(Misfit, FewReadingsCountAsStudentSays) {
  Observable observable{"a", "drop", "value", "mm", 10, 1, 10, {}};
  EXPECT_NEAR(few_readings_factor(observable), 2.262157 / 1.959964, 1e-6);
  observable.n = 2;
  EXPECT_NEAR(few_readings_factor(observable), 12.7062 / 1.959964, 1e-4);
  observable.sd.reset();
  EXPECT_EQ(few_readings_factor(observable), 1);
}

TEST(Misfit, FailuresNearbyMakeASetUnlikely) {
  Problem problem = full_problem(false);
  problem.settings.budget_s = 12000;
  const Misfit jammed = misfit_of(problem, true);
  const Misfit free = misfit_of(problem, false);
  const Point corner = {.5, .5, .5, .5, .95, .9};
  const std::size_t place = problem.observables.size();
  EXPECT_GT(jammed.residuals(corner, false).values[place], 1);
  EXPECT_LT(free.residuals(corner, false).values.size(),
            jammed.residuals(corner, false).values.size());
}

TEST(Misfit, AReadingThatNoRunHasIsNamedWithThoseThereAre) {
  Problem problem = full_problem(false);
  problem.observables[3].reading = "hight_mm";
  EXPECT_THAT(error_of([&] { misfit_of(problem, false); }),
              ::testing::AllOf(HasSubstr("heap: 0 of "), HasSubstr("\"base_radius_mm\"")));
}

TEST(Misfit, RunsOfAnotherProblemAreRefused) {
  const Problem problem = full_problem(false);
  EXPECT_THROW(in_order(problem, {{{"slump", kTruth, 1}, {}, ""}}), base::InputError);
  EXPECT_THROW(in_order(problem, {{{"heap", {.1}, 1}, {}, ""}}), base::InputError);
  EXPECT_THROW(in_order(problem, {{{"heap", {NAN, 0, 0, 0, 0, 0}, 1}, {}, ""}}), base::InputError);
}

TEST(Minimum, StaysInTheBoxAndHoldsWhatIsHeld) {
  const Misfit misfit = misfit_of(full_problem(false), false);
  const Minimum free = least_minimum(misfit, {});
  EXPECT_LT(free.chi2, .1);
  const Minimum held = minimum_from(misfit, Point(6, .99), 1);
  EXPECT_EQ(held.point[1], .99);
  EXPECT_GT(held.chi2, 100);
  for (const double x : held.point) {
    EXPECT_GE(x, 0);
    EXPECT_LE(x, 1);
  }
}

TEST(Plausible, SpreadIsThatOfTheKnowledge) {
  // Only the prior constrains the restitution between grains, so its spread comes back.
  const Problem problem = full_problem(false);
  const PosteriorSamples sets = posterior_samples(misfit_of(problem, false), 7);
  const double width = problem.parameters[3].max - problem.parameters[3].min;
  EXPECT_NEAR(problem.parameters[3].min + mean_of(sets.points)[3] * width, .2, .012);
  EXPECT_NEAR(sd_of(sets.points)[3] * width, .05, .008);
  EXPECT_NEAR(sd_of(sets.wide)[3] * width, .1, .02);
}

}  // namespace
}  // namespace repose::calibrate
