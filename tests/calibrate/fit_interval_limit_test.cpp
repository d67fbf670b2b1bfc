// How far chi2 may rise within an interval if few readings determine their scatter: compared with
// Student, Welch and Satterthwaite in closed form, and by how often intervals hold.

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/distributions.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

/// A reading 10 + slope · x of an experiment without random scatter, x in the unit box, and its
/// laboratory mean, sd and n.
struct LinearReading {
  std::vector<double> slope;
  double mean = 0;
  double sd = 0;
  int n = 0;
};

double reading_at(const LinearReading& reading, const std::vector<double>& x) {
  double value = 10;
  for (std::size_t j = 0; j < x.size(); ++j) value += reading.slope[j] * x[j];
  return value;
}

Problem problem_of(const std::vector<LinearReading>& readings) {
  Problem problem;
  for (std::size_t j = 0; j < readings.front().slope.size(); ++j) {
    problem.parameters.push_back({"x" + std::to_string(j), 0, 1, {}});
  }
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const std::string name = "reading " + std::to_string(k);
    Experiment experiment{.name = name, .parameters = {}, .is_stochastic = false};
    for (std::size_t j = 0; j < problem.parameters.size(); ++j) experiment.parameters.push_back(j);
    problem.experiments.push_back(experiment);
    problem.observables.push_back({.name = name,
                                   .experiment = name,
                                   .unit = "mm",
                                   .mean = readings[k].mean,
                                   .sd = readings[k].sd,
                                   .n = readings[k].n,
                                   .assumed_sd_fraction = {}});
  }
  return problem;
}

fake::Runs runs_of(const Problem& problem, const std::vector<LinearReading>& readings) {
  constexpr std::size_t kRuns = 12;
  fake::Runs runs;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    for (std::size_t i = 0; i < kRuns; ++i) {
      const Point x = sequence_point(i, problem.parameters.size());
      runs.push_back(
          {{problem.experiments[k].name, x, 1}, {{"value", reading_at(readings[k], x)}}, ""});
    }
  }
  return runs;
}

double half_width(const FittedParameter& parameter) {
  return (parameter.interval.high - parameter.interval.low) / 2;
}

JointFit fit_of_readings(const std::vector<LinearReading>& readings) {
  const Problem problem = problem_of(readings);
  return fit_jointly(problem, runs_of(problem, readings));
}

double t_95(double df) { return base::student_t_quantile(.975, df); }

TEST(IntervalLimit, OfOneReadingIsStudents) {
  for (const auto& [n, t] : {std::pair{3, 4.302653}, std::pair{5, 2.776445}}) {
    const double half = t * .5 / std::sqrt(n) / 20;
    EXPECT_NEAR(half_width(fit_of_readings({{{20}, 20, .5, n}}).parameters[0]), half, .01 * half)
        << n;
  }
}

// Two readings determine two parameters as half their sum and half their difference. GUM G.2b: the
// sum of two equal variances, each with four degrees of freedom, has eight: t = 2.306.
TEST(IntervalLimit, OfTwoEqualReadingsOfTwoParametersHasTheirDegreesTogether) {
  const JointFit fit = fit_of_readings({{{20, 20}, 30, .5, 5}, {{20, -20}, 10, .5, 5}});
  const double half = 2.306004 * (.5 / std::sqrt(5)) / (20 * std::sqrt(2));
  EXPECT_NEAR(fit.parameters[0].value, .5, .001);
  EXPECT_NEAR(half_width(fit.parameters[0]), half, .01 * half);
  EXPECT_NEAR(half_width(fit.parameters[1]), half, .01 * half);
}

TEST(IntervalLimit, OfReadingsThatDifferHasWelchsDegrees) {
  const double u1 = .6 / std::sqrt(3), u2 = .9 / std::sqrt(6);
  const JointFit fit = fit_of_readings({{{20, 20}, 30, .6, 3}, {{20, -20}, 10, .9, 6}});
  const double df = std::pow(u1 * u1 + u2 * u2, 2) / (std::pow(u1, 4) / 2 + std::pow(u2, 4) / 5);
  const double half = t_95(df) * std::hypot(u1, u2) / 40;
  EXPECT_NEAR(half_width(fit.parameters[0]), half, .01 * half);
}

// Meier (1953), equation for the variance of a weighted mean: weights of 1/2 each, estimated with
// four degrees of freedom, multiply it by 1 + 4 · (1/4 + 1/4) / 4.
TEST(IntervalLimit, OfTwoReadingsOfOneParameterPaysForTheirWeights) {
  const double half = 2.306004 * .5 / std::sqrt(10) * std::sqrt(1.5) / 20;
  EXPECT_NEAR(half_width(fit_of_readings({{{20}, 20, .5, 5}, {{20}, 20, .5, 5}}).parameters[0]),
              half, .01 * half);
}

TEST(IntervalLimit, IsThatOfTheNormalDistributionWhereScattersAreKnown) {
  const std::vector<LinearReading> readings = {{{20, 20}, 30, .5, 3}, {{20, -20}, 10, .5, 3}};
  Problem problem = problem_of(readings);
  for (Observable& observable : problem.observables) observable.is_sd_known = true;
  const Misfit misfit(problem, in_order(problem, runs_of(problem, readings)), {}, false);
  EXPECT_EQ(misfit.interval_limit({.5, .5}, 0), kChi2Limit);
}

// A parameter that no reading determines lies within its bounds, so it hardly affects the others.
TEST(IntervalLimit, OfAParameterIsTheSameBesideOneThatNoReadingTells) {
  const JointFit fit =
      fit_of_readings({{{20, 20, .01}, 30.005, .5, 5}, {{20, -20, .01}, 10.005, .5, 5}});
  const double half = 2.306004 * (.5 / std::sqrt(5)) / (20 * std::sqrt(2));
  EXPECT_NEAR(half_width(fit.parameters[0]), half, .02 * half);
  EXPECT_EQ(fit.parameters[2].verdict, Verdict::undetermined);
}

// The common error is known: GUM G.2b with infinite degrees of freedom for it.
TEST(IntervalLimit, WhatReadingsHaveInCommonMakesDegreesMore) {
  const std::vector<LinearReading> readings = {{{20}, 20, .5, 4}};
  Problem problem = problem_of(readings);
  const double u = .25;
  problem.observables[0].systematic_sd = .5;
  const FittedParameter x = fit_jointly(problem, runs_of(problem, readings)).parameters[0];
  const double variance = u * u + .25;
  const double half = t_95(variance * variance / (std::pow(u, 4) / 3)) * std::sqrt(variance) / 20;
  EXPECT_NEAR(half_width(x), half, .01 * half);
}

TEST(IntervalLimit, OfAParameterAtItsBoundIsThatOfItsReading) {
  const std::vector<LinearReading> readings = {{{20}, 29.9, .5, 5}};
  const Problem problem = problem_of(readings);
  const Misfit misfit(problem, in_order(problem, runs_of(problem, readings)), {}, false);
  EXPECT_NEAR(misfit.interval_limit({1}, 0), kChi2Limit, .02);
}

TEST(IntervalLimit, ProfilesAreInUnitsOfWhichTheNormalLimitEndsThem) {
  const FittedParameter x =
      fit_of_readings({{{20, 20}, 30, .5, 5}, {{20, -20}, 10, .5, 5}}).parameters[0];
  bool is_any = false;
  for (const ProfilePoint& point : x.profile) {
    const double off = (point.value - x.value) / half_width(x);
    if (std::abs(off) < .3) continue;
    is_any = true;
    EXPECT_NEAR(point.chi2 / (kChi2Limit * off * off), 1, .05);
  }
  EXPECT_TRUE(is_any);
}

TEST(IntervalLimit, EquallyGoodSetsAreWithinAllIntervals) {
  const JointFit fit = fit_of_readings({{{20, 20}, 30, 4, 3}, {{20, -20}, 10, 4, 3}});
  ASSERT_FALSE(fit.equivalence_family.empty());
  for (const ParameterSet& set : fit.equivalence_family) {
    for (std::size_t j = 0; j < set.values.size(); ++j) {
      EXPECT_GE(set.values[j], fit.parameters[j].interval.low);
      EXPECT_LE(set.values[j], fit.parameters[j].interval.high);
    }
  }
}

/// Laboratory readings at the centre of the box, `n` of each kind, with an sd of .2.
struct Bench {
  std::vector<std::vector<double>> slopes;
  std::vector<int> n;
};

/// How often the interval of each parameter holds the truth, in percent: how often chi2 at the true
/// value, with all others refitted, exceeds its minimum by no more than the limit.
std::vector<double> held_percent(const Bench& bench, std::uint64_t seed) {
  constexpr int kDraws = 600;
  constexpr double kSd = .2;
  const std::size_t parameters = bench.slopes.front().size();
  const Point truth(parameters, .5);
  Random random(seed);
  std::vector<double> held(parameters, 0);
  std::optional<Misfit> before;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<LinearReading> readings;
    for (std::size_t k = 0; k < bench.slopes.size(); ++k) {
      LinearReading& reading =
          readings.emplace_back(LinearReading{bench.slopes[k], 0, 0, bench.n[k]});
      double sum = 0, squares = 0;
      for (int i = 0; i < reading.n; ++i) {
        const double error = kSd * random.normal();
        sum += error;
        squares += error * error;
      }
      reading.mean = reading_at(reading, truth) + sum / reading.n;
      reading.sd = std::sqrt((squares - sum * sum / reading.n) / (reading.n - 1));
    }
    const Problem problem = problem_of(readings);
    const std::vector<Run> runs = in_order(problem, runs_of(problem, readings));
    const Misfit misfit(problem, runs, before, false);
    if (!before) before = misfit;
    const Minimum best = minimum_from(misfit, truth);
    for (std::size_t j = 0; j < parameters; ++j) {
      const double there = minimum_from(misfit, truth, j).chi2;
      held[j] += there - best.chi2 <= misfit.interval_limit(best.point, j) ? 100. / kDraws : 0;
    }
  }
  return held;
}

const std::vector<std::vector<double>> kOneReading = {{20}};
const std::vector<std::vector<double>> kTwoOfTwo = {{20, 10}, {6, 20}};
const std::vector<std::vector<double>> kThreeOfTwo = {{20, 10}, {6, 20}, {20, 20}};
const std::vector<std::vector<double>> kTwoOfOne = {{20}, {20}};

void expect_held(const Bench& bench, double least, double most) {
  for (const double percent : held_percent(bench, 5)) {
    EXPECT_GE(percent, least) << ::testing::PrintToString(bench.n);
    EXPECT_LE(percent, most) << ::testing::PrintToString(bench.n);
  }
}

// 600 trials of 95 % scatter by .9 % (one sigma). Without the limit, two readings of two parameters
// hold 96.3 to 98.2 %.
TEST(IntervalLimit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  for (const int n : {3, 5, 6}) expect_held({kOneReading, {n}}, 93, 97);
  expect_held({kTwoOfTwo, {3, 3}}, 93, 97);
  expect_held({kTwoOfTwo, {5, 5}}, 93, 97);
  expect_held({kTwoOfTwo, {6, 5}}, 93, 97);
  expect_held({kTwoOfTwo, {5, 10}}, 93, 97);
  expect_held({kThreeOfTwo, {5, 5, 6}}, 92, 97);
}

// Estimated weights are corrected to first order in one over the degrees of freedom. Without that,
// five readings each hold 89.8 %.
TEST(IntervalLimit, ReadingsOfOneParameterAreNotCountedTwice) {
  expect_held({kTwoOfOne, {5, 5}}, 91.5, 97);
  expect_held({kTwoOfOne, {6, 10}}, 91.5, 97);
}

}  // namespace
}  // namespace repose::calibrate
