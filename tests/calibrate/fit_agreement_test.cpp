#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/verification.h"
#include "tests/support/texts_of.h"

namespace repose::calibrate {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Plates simulated to slide `off` standard uncertainties away from the measured angle, whose mean
/// is known from many readings: each is a separate experiment without random scatter.
struct Plates {
  Problem problem;
  std::vector<Run> runs;
};

Plates plates(const std::vector<double>& off, double uncertainty) {
  constexpr int kReadings = 10'000;
  Plates made;
  made.problem.parameters = {{"friction", 0, 1, {}}};
  for (std::size_t k = 0; k < off.size(); ++k) {
    const std::string name = "plate " + std::to_string(k);
    made.problem.experiments.push_back({name, {0}, 1, false, {"value"}});
    made.problem.observables.push_back(
        {name, name, "value", "deg", 20, 100 * uncertainty, kReadings, {}});
    made.runs.push_back({{name, {.5}, 1}, {{"value", 20 + off[k] * uncertainty}}, ""});
  }
  return made;
}

Verification checked(const Plates& made) { return verify(made.problem, {.5}, made.runs); }

TEST(Agreement, SmallDifferencesAreADisagreementTogether) {
  // None exceeds 2.5, the individual limit at 5 % over four readings. The tolerance is 2 degrees.
  const Verification one = checked(plates({-.4, 0, 2.4, 2.1}, 1.1));
  EXPECT_EQ(one.verdict, AgreementVerdict::disagrees);
  EXPECT_NEAR(one.chance, .035, .001);  // of .16 + 0 + 5.76 + 4.41, chi-square, 4 df
  for (const Agreement& agreement : one.observables) {
    EXPECT_NE(agreement.verdict, AgreementVerdict::disagrees) << agreement.observable;
  }
}

TEST(Agreement, OneThatDiffersByItselfIsNamed) {
  const Verification one = checked(plates({.1, 0, 4, -.2}, 1));
  EXPECT_EQ(one.verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(one.observables[2].verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(one.observables[0].verdict, AgreementVerdict::agrees);
}

TEST(Agreement, WithinTheToleranceTheyAgreeHoweverSureTheDifference) {
  const Plates made = plates({9, -9}, .1);
  EXPECT_EQ(checked(made).verdict, AgreementVerdict::agrees) << "0.9 of 2 degrees";
  Plates strict = made;
  strict.problem.observables[0].tolerance = .5;
  EXPECT_EQ(checked(strict).observables[0].verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(checked(strict).verdict, AgreementVerdict::disagrees);
}

TEST(Agreement, WhatLeavesMoreOpenThanTheToleranceCannotBeTold) {
  const Verification one = checked(plates({.1, .2}, 3));
  EXPECT_EQ(one.verdict, AgreementVerdict::cannot_tell);
  EXPECT_NEAR(one.observables[0].detectable, 3 * (2.2414 + .8416), .01);  // at 2.5 % each
  EXPECT_FALSE(one.observables[0].runs_to_decide) << "the bench's own readings leave it open";
}

TEST(Agreement, OneAndAllNeverContradictEachOther) {
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const Verification one = checked(plates({2 * random.normal(), random.normal()}, 1));
    for (const Agreement& agreement : one.observables) {
      if (agreement.verdict != AgreementVerdict::disagrees) continue;
      EXPECT_EQ(one.verdict, AgreementVerdict::disagrees);
    }
  }
}

TEST(Agreement, EqualMeansAreRarelyCalledDifferentAndFarOnesRarelyAlike) {
  Random random(3);
  int wrong = 0;
  int alike = 0;
  for (int k = 0; k < 400; ++k) {
    const auto at = [&](double mean) { return mean + random.normal(); };
    wrong += checked(plates({at(0), at(0), at(0)}, 1)).verdict == AgreementVerdict::disagrees;
    // Exactly the tolerance apart: agreement may be claimed in 5 % of cases.
    alike += checked(plates({at(5)}, .4)).verdict == AgreementVerdict::agrees;
  }
  EXPECT_LE(wrong, 33);  // 20 +- 4.4 expected
  EXPECT_LE(alike, 33);
  EXPECT_GT(wrong, 6);
  EXPECT_GT(alike, 6);
}

TEST(Agreement, AnExperimentThatNeverGivesAReadingDisagrees) {
  Plates made = plates({0, 0}, .1);
  made.runs[1] = {made.runs[1].job, {}, "it does not slide"};
  const Verification one = checked(made);
  EXPECT_EQ(one.observables[1].verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(one.verdict, AgreementVerdict::disagrees);
  made.runs.pop_back();
  EXPECT_EQ(checked(made).verdict, AgreementVerdict::cannot_tell) << "it was not run";
}

TEST(Agreement, ReadingsOfOneHeapAreJudgedByWhatTheyShare) {
  Plates made = plates({2, 2}, 1);
  made.problem.experiments.pop_back();
  made.problem.observables[1].experiment = made.problem.experiments[0].name;
  made.problem.observables[1].reading = "radius";
  made.runs = {{{"plate 0", {.5}, 1}, {{"value", 22}, {"radius", 22}}, ""}};
  const auto chance_with = [&](double correlation) {
    JointFit fit;
    fit.observables.resize(2);
    for (FittedObservable& fitted : fit.observables) fitted.measured_uncertainty = 1;
    fit.surrogates.resize(2);
    fit.reading_correlation = {{1, correlation}, {correlation, 1}};
    fit.bench_correlation = fit.reading_correlation;
    return verify(made.problem, {.5}, made.runs, &fit).chance;
  };
  EXPECT_NEAR(chance_with(0), std::exp(-8 / 2.), 1e-4);  // chi-square with 2 degrees of freedom
  EXPECT_NEAR(chance_with(.9), std::exp(-8 / 1.9 / 2), 1e-4);
  EXPECT_LT(chance_with(-.9), 1e-9);
}

TEST(Agreement, RunsToDecideDecide) {
  // Measured 0 +- .3; three runs with an sd of 2.5, off by one degree; tolerance 2.
  const UncertainMean measured{0, .3, kInfinite};
  const auto after = [&](int runs) {
    return difference_of({1, 2.5 / std::sqrt(runs), 40}, measured);
  };
  EXPECT_GT(equivalence_interval(after(3)).high, 2);
  const std::optional<int> needed = runs_to_decide(after(3), .3, 3, 2, .05);
  ASSERT_TRUE(needed);
  EXPECT_GT(*needed, 30);
  EXPECT_LT(*needed, 90);
  EXPECT_LT(equivalence_interval(after(*needed)).high, 2);
  EXPECT_FALSE(runs_to_decide(after(3), 1.5, 3, 2, .05)) << "the bench is too unsure";
}

TEST(Agreement, FewRunsCountAsStudentSays) {
  const UncertainMean few = difference_of({1, 1, 2}, {0, 0, kInfinite});
  EXPECT_NEAR(equivalence_interval(few).high, 1 + 2.91999, 1e-4);
  EXPECT_NEAR(chance_of(few), .42265, 1e-4);
  EXPECT_NEAR(difference_of({1, 3, 4}, {0, 3, 4}).df, 8, 1e-9) << "alike: both together";
}

TEST(Agreement, MarginsAreFixedBeforehand) {
  Observable observable{"a", "drop", "value", "mm", 400, 1, 10, {}};
  const auto margin = [&](const std::optional<Interval>& possible) {
    return margin_of(observable, possible);
  };
  EXPECT_EQ(margin({}).value, 40);
  EXPECT_EQ(margin({}).source, MarginSource::reading);
  observable.sd = 1000;  // larger scatter of the readings does not make agreement easier
  EXPECT_EQ(margin(Interval{0, 1000}).value, 40);
  EXPECT_NEAR(margin(Interval{390, 410}).value, 2, 1e-12);
  EXPECT_EQ(margin(Interval{390, 410}).source, MarginSource::range);
  EXPECT_EQ(margin(Interval{400, 400}).value, 0) << "it tells nothing of the coefficients";
  observable.unit = "deg";
  EXPECT_EQ(margin({}).value, 2);
  EXPECT_EQ(margin({}).source, MarginSource::angle);
  observable.tolerance = 3;
  EXPECT_EQ(margin(Interval{400, 400}).value, 3);
  EXPECT_EQ(margin({}).source, MarginSource::study);
}

TEST(Agreement, ReadingsToDecideDecide) {
  // A ball rebounds 100 +- 60 mm in three readings, simulated to within a millimetre; margin 10 mm.
  const auto after = [](int readings) {
    return difference_of({101, .1, 40}, {100, 60 / std::sqrt(readings), readings - 1.});
  };
  EXPECT_GT(equivalence_interval(after(3)).high, 10);
  const std::optional<int> needed = readings_to_decide(after(3), 60 / std::sqrt(3), 3, 10, .05);
  ASSERT_TRUE(needed);
  EXPECT_NEAR(*needed, std::pow(60 * (1.645 + .842) / 9, 2), 3);
  EXPECT_LT(equivalence_interval(after(*needed)).high, 10);
  EXPECT_FALSE(readings_to_decide(difference_of({101, 8, 40}, {100, 1, 9}), 1, 10, 10, .05))
      << "the runs leave too much open";
}

TEST(Agreement, AToleranceMustBeAboveZero) {
  Problem problem = plates({0}, 1).problem;
  problem.observables[0].tolerance = 0;
  EXPECT_THAT(texts_of(errors_of(problem)),
              ::testing::Contains(::testing::HasSubstr("tolerance = 0 must be a number above 0")));
}

}  // namespace
}  // namespace repose::calibrate
