#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using fake::kTruth;

bool holds(const FittedParameter& parameter, double value) {
  return parameter.interval.low <= value && value <= parameter.interval.high;
}

/// One study of all made-up experiments, shared by the tests that only inspect it.
class JointFitOfTheBench : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    problem_ = new Problem(fake::problem(kTruth, 1));
    runs_ = new fake::Runs(fake::study(*problem_));
    fit_ = new JointFit(fit_jointly(*problem_, *runs_));
  }
  static void TearDownTestSuite() {
    delete problem_;
    delete runs_;
    delete fit_;
  }

  static Problem* problem_;
  static fake::Runs* runs_;
  static JointFit* fit_;
};

Problem* JointFitOfTheBench::problem_ = nullptr;
fake::Runs* JointFitOfTheBench::runs_ = nullptr;
JointFit* JointFitOfTheBench::fit_ = nullptr;

TEST_F(JointFitOfTheBench, DeterminesTheWallAndHoldsTheTruth) {
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_TRUE(holds(fit_->parameters[j], kTruth[j])) << fit_->parameters[j].name;
    EXPECT_TRUE(holds(fit_->parameters[j], fit_->parameters[j].value));
  }
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(fit_->parameters[j].verdict, Verdict::determined);
    EXPECT_THAT(fit_->parameters[j].advice, IsEmpty());
  }
  EXPECT_NEAR(fit_->parameters[1].value, .42, .02);
  EXPECT_LT(fit_->parameters[1].interval.high - fit_->parameters[1].interval.low, .06);
}

TEST_F(JointFitOfTheBench, SaysThatTheHeapCannotSeeRestitution) {
  const FittedParameter& restitution = fit_->parameters[3];
  EXPECT_EQ(restitution.verdict, Verdict::undetermined);
  EXPECT_THAT(restitution.advice, HasSubstr("not identifiable"));
}

TEST_F(JointFitOfTheBench, NamesTheReadingThatWouldCutTheValley) {
  // One angle, two frictions between grains: the base radius isolates sliding friction.
  EXPECT_NE(fit_->parameters[4].verdict, Verdict::determined);
  EXPECT_THAT(fit_->parameters[4].advice, HasSubstr("base_radius_mm"));
}

TEST_F(JointFitOfTheBench, FindsTheValley) {
  ASSERT_GE(fit_->equivalence_family.size(), 3);
  double least = 1;
  double most = 0;
  for (const ParameterSet& set : fit_->equivalence_family) {
    EXPECT_LE(set.chi2, 3.85);
    // The true angle of the made-up heap there; without nearby runs it is known no better.
    EXPECT_NEAR(fake::expected("heap", "value", set.values), 22.5, 4);
    least = std::min(least, set.values[4]);
    most = std::max(most, set.values[4]);
  }
  EXPECT_GT(most - least, .2);
  EXPECT_LT(fit_->correlation[4][5], -.4);
}

TEST_F(JointFitOfTheBench, AgreesWithTheMeasurements) {
  for (const FittedObservable& observable : fit_->observables) {
    EXPECT_LT(std::abs(observable.difference_sigma), 1) << observable.name;
    const double truth = fake::expected(observable.name, "value", kTruth);
    EXPECT_NEAR(observable.simulated, truth, 4 * observable.measured_uncertainty);
    EXPECT_LE(observable.reachable.low, observable.measured);
    EXPECT_GE(observable.reachable.high, observable.measured);
  }
  EXPECT_GE(fit_->observables[0].reachable.low, 0);  // no rebound below the floor
}

TEST_F(JointFitOfTheBench, KnowsItsSurrogates) {
  for (const SurrogateQuality& quality : fit_->surrogates) {
    EXPECT_GE(quality.runs, 8);
    EXPECT_GE(quality.inflation, 1);
    EXPECT_GT(quality.leave_one_out_sigma, 0);
    EXPECT_LT(quality.leave_one_out_sigma, 1.6) << quality.observable;
  }
  EXPECT_GT(fit_->surrogates[2].warp, 0);  // rolling distances span decades
  EXPECT_NEAR(fit_->observables[2].simulated_sd / fit_->observables[2].simulated, .4, .15);
}

TEST_F(JointFitOfTheBench, CurvesAndSurfacesPassThroughTheFit) {
  // 1 + 1 + 3 parameters of the single grain, 6 of the heap; 3 and 15 pairs.
  std::size_t expected_curves = 0;
  for (const Observable& observable : problem_->observables) {
    for (const Experiment& experiment : problem_->experiments) {
      if (experiment.name == observable.experiment) {
        expected_curves += experiment.parameters.size();
      }
    }
  }
  EXPECT_EQ(fit_->curves.size(), expected_curves);
  for (const ResponseCurve& curve : fit_->curves) {
    const FittedObservable& observable = fit_->observables[curve.observable];
    const double best = fit_->parameters[curve.parameter].value;
    const auto after = std::lower_bound(curve.values.begin(), curve.values.end(), best);
    const auto k =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - curve.values.begin(), 1, 40));
    const double fraction = (best - curve.values[k - 1]) / (curve.values[k] - curve.values[k - 1]);
    const double there =
        curve.simulated[k - 1] + fraction * (curve.simulated[k] - curve.simulated[k - 1]);
    EXPECT_NEAR(there, observable.simulated, .03 * std::abs(observable.simulated));
    EXPECT_THAT(curve.uncertainty, ::testing::Each(::testing::Gt(0)));
    EXPECT_THAT(curve.scatter, ::testing::Each(::testing::Ge(0)));
  }
  const ResponseSurface& surface = fit_->surfaces.back();
  ASSERT_EQ(surface.simulated.size(), surface.y.size());
  ASSERT_EQ(surface.simulated.front().size(), surface.x.size());
  EXPECT_EQ(surface.x.front(), problem_->parameters[surface.x_parameter].min);
  EXPECT_EQ(surface.y.back(), problem_->parameters[surface.y_parameter].max);
}

TEST_F(JointFitOfTheBench, ProfilesRiseFromTheBestToTheLimit) {
  const FittedParameter& sliding = fit_->parameters[1];
  ASSERT_GE(sliding.profile.size(), 5);
  EXPECT_TRUE(std::is_sorted(
      sliding.profile.begin(), sliding.profile.end(),
      [](const ProfilePoint& a, const ProfilePoint& b) { return a.value < b.value; }));
  EXPECT_GT(sliding.profile.front().chi2, 3.5);
  EXPECT_GT(sliding.profile.back().chi2, 3.5);
}

TEST_F(JointFitOfTheBench, TellsItsHistory) {
  ASSERT_GE(fit_->rounds.size(), 3);
  EXPECT_EQ(fit_->rounds.back().jobs, static_cast<int>(runs_->size()));
  EXPECT_LT(fit_->rounds.back().sd[0], fit_->rounds.front().sd[0]);
}

TEST_F(JointFitOfTheBench, IsTheSameToTheLastBitInAnyOrder) {
  fake::Runs runs = *runs_;
  std::reverse(runs.begin(), runs.end());
  runs.push_back(runs.front());
  const JointFit again = fit_jointly(*problem_, runs);
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_EQ(again.parameters[j].value, fit_->parameters[j].value);
    EXPECT_EQ(again.parameters[j].interval.low, fit_->parameters[j].interval.low);
    EXPECT_EQ(again.parameters[j].interval.high, fit_->parameters[j].interval.high);
  }
  EXPECT_EQ(again.correlation, fit_->correlation);
  EXPECT_EQ(again.chi2, fit_->chi2);
}

/// Only a tilting plate: quick, with a closed-form solution.
Problem plate(double mean, double sd, int n) {
  Problem problem;
  problem.parameters = {{"friction", .1, .8, {}}};
  problem.experiments = {{"tilt", {0}, .5, false, {"value"}}};
  problem.observables = {{"tilt", "tilt", "value", "deg", mean, sd, n, {}}};
  return problem;
}

/// Slides at 50 degrees per unit of friction.
fake::Runs plate_runs(const Problem& problem) {
  fake::Runs runs;
  for (const Job& job : propose(problem, runs)) {
    runs.push_back({job, {{"value", 50 * job.values[0]}}, ""});
  }
  return runs;
}

JointFit plate_fit(const Problem& problem) { return fit_jointly(problem, plate_runs(problem)); }

TEST(JointFit, OneParameterOfOneReadingHasStudentsInterval) {
  for (const int n : {3, 10}) {
    const double t = n == 3 ? 4.302653 : 2.262157;
    const FittedParameter friction = plate_fit(plate(20, .9, n)).parameters[0];
    const double half = t * .9 / std::sqrt(n) / 50;
    EXPECT_NEAR(friction.value, .4, .001);
    EXPECT_NEAR(friction.interval.low, .4 - half, .03 * half);
    EXPECT_NEAR(friction.interval.high, .4 + half, .03 * half);
  }
}

TEST(JointFit, AnIntervalThatMeetsOneBoundIsOneSided) {
  const JointFit fit = plate_fit(plate(39.5, .9, 10));
  EXPECT_EQ(fit.parameters[0].verdict, Verdict::one_sided);
  EXPECT_EQ(fit.parameters[0].interval.high, .8);
  EXPECT_GT(fit.parameters[0].interval.low, .7);
}

TEST(JointFit, ATargetOutOfReachIsToldWithTheRangeAndTheBoundThatLimitsIt) {
  const JointFit fit = plate_fit(plate(60, .9, 10));
  EXPECT_EQ(fit.parameters[0].value, .8);
  EXPECT_NEAR(fit.observables[0].reachable.low, 5, .2);
  EXPECT_NEAR(fit.observables[0].reachable.high, 40, .2);
  EXPECT_LT(fit.observables[0].difference_sigma, -10);
  EXPECT_THAT(fit.warnings, Contains(::testing::AllOf(HasSubstr("cannot be reached"),
                                                      HasSubstr("friction = 0.8"))));
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("no parameter set fits all measurements")));
}

TEST(JointFit, ReachIsToldAsFarAsABenchCanReadIt) {
  Problem problem = plate(60, .9, 10);
  problem.observables[0].least = 12;
  problem.observables[0].most = 30;
  const JointFit fit = plate_fit(problem);
  EXPECT_EQ(fit.observables[0].reachable.low, 12);
  EXPECT_EQ(fit.observables[0].reachable.high, 30);
}

TEST(JointFit, WithinReachNothingIsSaidOfIt) {
  EXPECT_THAT(plate_fit(plate(20, .9, 10)).warnings, IsEmpty());
}

TEST(JointFit, ReadingsThatAreMoreAlikeThanChanceAllowsAreNamed) {
  const auto warnings_of = [](double sd, int n) {
    Problem problem = plate(20, sd, n);
    problem.experiments[0].is_stochastic = true;
    fake::Runs runs = plate_runs(problem);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      runs[k].readings["value"] += k % 2 == 0 ? 2 : -2;  // single readings scatter by 2
    }
    return fit_jointly(problem, runs).warnings;
  };
  const auto names_it = Contains(HasSubstr("so little is rare by chance"));
  EXPECT_THAT(warnings_of(.6, 10), names_it);
  EXPECT_THAT(warnings_of(2, 10), Not(names_it));
  EXPECT_THAT(warnings_of(6, 10), Not(names_it)) << "benches scatter for more reasons";
  EXPECT_THAT(warnings_of(.6, 2), Not(names_it)) << "two are alike now and then";
}

TEST(JointFit, KnowledgeBeforehandCounts) {
  // The measurement gives .4 +- .1, the prior .3 +- .1: the fit lies half-way between them.
  Problem problem = plate(20, 0, 1);
  problem.observables[0].sd.reset();
  problem.observables[0].assumed_sd_fraction = .25;
  problem.parameters[0].prior = Prior{.3, .1};
  const JointFit fit = plate_fit(problem);
  EXPECT_NEAR(fit.parameters[0].value, .35, .003);
  EXPECT_NEAR(fit.chi2, .5, .02);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("assumed: sd 25 %")));
}

TEST(JointFit, AnIntervalThatIsOnlyTheKnowledgeBeforehandIsCalledThat) {
  Problem problem = plate(20, 9, 2);
  problem.parameters[0].prior = Prior{.4, .02};
  EXPECT_THAT(plate_fit(problem).warnings, Contains(HasSubstr("that of the prior")));
  problem.observables[0].n = 100;
  EXPECT_THAT(plate_fit(problem).warnings, Not(Contains(HasSubstr("that of the prior"))));
}

TEST(JointFit, AWideIntervalInsideItsBoundsIsBoundedNotDetermined) {
  // 22 +- 10 degrees from five readings: Student's interval is +- 12 degrees.
  Problem problem = plate(22, 10, 5);
  const FittedParameter wide = plate_fit(problem).parameters[0];
  EXPECT_EQ(wide.verdict, Verdict::bounded);
  EXPECT_THAT(wide.advice, HasSubstr("more bench readings"));
  problem.parameters[0].useful_half_width = .3;
  EXPECT_EQ(plate_fit(problem).parameters[0].verdict, Verdict::determined);
  EXPECT_EQ(plate_fit(plate(22, 3, 5)).parameters[0].verdict, Verdict::determined);
  problem.parameters[0].useful_half_width = 0;
  EXPECT_THROW(plate_fit(problem), base::InputError);
}

TEST(JointFit, ARobustFitFollowsTheMajority) {
  Problem problem = plate(20, .9, 10);
  problem.observables.push_back(problem.observables[0]);
  problem.observables.push_back(problem.observables[0]);
  problem.observables[1].name = "again";
  problem.observables[2].name = "wrong";
  problem.observables[2].mean = 35;
  EXPECT_GT(plate_fit(problem).parameters[0].value, .48);
  problem.settings.robust = true;
  EXPECT_NEAR(plate_fit(problem).parameters[0].value, .4, .01);
}

TEST(JointFit, AConstantReadingIsSaidToDetermineNothing) {
  const Problem problem = plate(20, .9, 10);
  fake::Runs runs = plate_runs(problem);
  for (auto& run : runs) run.readings["value"] = 20;
  const JointFit fit = fit_jointly(problem, runs);
  EXPECT_EQ(fit.parameters[0].verdict, Verdict::undetermined);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("every simulation gave 20 deg")));
}

TEST(JointFit, AnExperimentNotMadeIsAdvised) {
  Problem problem = plate(20, .9, 10);
  problem.parameters.push_back({"bounce", 0, 1, {}});
  problem.experiments[0].parameters.push_back(1);
  problem.experiments.push_back({"drop", {1}, 1, true, {"value"}});
  const JointFit fit = plate_fit(problem);
  EXPECT_EQ(fit.parameters[1].verdict, Verdict::undetermined);
  EXPECT_THAT(fit.parameters[1].advice, HasSubstr("do the drop experiment"));
}

TEST(JointFit, AnExperimentThatTellsAnOpenParameterIsAdvisedUnlessTheStudyHasIt) {
  Problem problem = plate(20, .9, 10);
  problem.parameters.push_back({"bounce", 0, 1, {}, {"drop", "pendulum"}});
  EXPECT_THAT(plate_fit(problem).parameters[1].advice,
              HasSubstr("add [experiment.drop] or [experiment.pendulum]"));
  problem.experiments.push_back({"drop", {1}, 1, true, {"value"}});
  EXPECT_THAT(plate_fit(problem).parameters[1].advice,
              AllOf(HasSubstr("do the drop experiment"), Not(HasSubstr("add ["))));
}

TEST(JointFit, AnExperimentThatAPlanSimulatedIsAdvisedWithWhatItWouldGive) {
  Problem problem = plate(20, .9, 10);
  problem.parameters.push_back({"bounce", 0, 1, {}, {"drop"}});
  Offer& offer = problem.offers.emplace_back(
      Offer{{"pendulum", {1}, 1, true, {"value"}}, "[experiment.pendulum]\nstring_mm = 300\n", {}});
  constexpr int kRuns = 20;
  for (int k = 0; k < kRuns; ++k) {
    const double bounce = (k + .5) / kRuns;
    offer.runs.push_back({.job = {"pendulum", {.4, bounce}, static_cast<std::uint64_t>(k)},
                          .readings = {{"value", 10 + 20 * bounce + (k % 2 == 0 ? .1 : -.1)}},
                          .failure = {}});
  }
  const JointFit fit = plate_fit(problem);
  EXPECT_THAT(fit.parameters[1].advice,
              AllOf(HasSubstr("add [experiment.pendulum]"), HasSubstr("would reduce"),
                    Not(HasSubstr("[experiment.drop]"))));
  ASSERT_EQ(fit.additions.size(), 1U) << "the lines to add are given";
  EXPECT_EQ(fit.additions[0].experiment, "pendulum");
  EXPECT_EQ(fit.additions[0].lines, "[experiment.pendulum]\nstring_mm = 300\n");
  offer.experiment.systematic_sd = 20;
  EXPECT_THAT(plate_fit(problem).parameters[1].advice, Not(HasSubstr("[experiment.pendulum]")))
      << "ten readings do not lower what they share";
  offer.experiment.systematic_sd = 0;
  for (std::size_t k = 0; k < 11; ++k) {
    offer.runs[k].readings.clear();
    offer.runs[k].failure = "they miss each other";
  }
  EXPECT_THAT(plate_fit(problem).parameters[1].advice, HasSubstr("add [experiment.drop]"))
      << "one that gives a reading of few materials is no advice";
}

TEST(JointFit, WhereTheBenchScattersMoreReadingsAreAdvised) {
  EXPECT_THAT(plate_fit(plate(20, 30, 4)).parameters[0].advice,
              HasSubstr("take more bench readings of tilt: 16 in place of 4"));
}

TEST(JointFit, MoreSimulationsAreAdvisedWhereTheyWouldNarrow) {
  Problem problem = plate(39.5, .1, 10);
  problem.experiments[0].is_stochastic = true;
  fake::Runs runs = plate_runs(problem);
  double side = 1;
  for (auto& run : runs) run.readings["value"] += 3 * (side = -side);
  const JointFit noisy = fit_jointly(problem, runs);
  EXPECT_THAT(noisy.parameters[0].advice, AllOf(HasSubstr("simulate more: means known exactly"),
                                                Not(HasSubstr("take more bench readings"))));
  EXPECT_THAT(noisy.warnings, Contains(HasSubstr("a larger budget would narrow the intervals")));
  problem.settings.are_runs_given = true;
  EXPECT_THAT(fit_jointly(problem, runs).warnings,
              Contains(HasSubstr("more runs would narrow the intervals")));
  EXPECT_THAT(plate_fit(plate(39.5, .9, 10)).parameters[0].advice, Not(HasSubstr("simulate more")));
}

TEST(JointFit, AParameterThatNothingMeasuredDependsOnStaysOpenAndTheOthersAreFound) {
  Problem problem = plate(20, .9, 10);
  const FittedParameter alone = plate_fit(problem).parameters[0];
  problem.parameters.push_back({"bounce", .2, .9, {}});
  const JointFit fit = plate_fit(problem);
  EXPECT_NEAR(fit.parameters[0].value, alone.value, .001);
  EXPECT_NEAR(fit.parameters[0].interval.low, alone.interval.low, .001);
  EXPECT_NEAR(fit.parameters[0].interval.high, alone.interval.high, .001);
  EXPECT_EQ(fit.parameters[1].verdict, Verdict::undetermined);
  EXPECT_EQ(fit.parameters[1].interval.low, .2);
  EXPECT_EQ(fit.parameters[1].interval.high, .9);
  EXPECT_THAT(fit.parameters[1].advice, HasSubstr("not identifiable from these experiments"));
}

TEST(JointFit, FailedRunsAreCountedAndKeptAwayFrom) {
  Problem problem = fake::problem(kTruth, 3);
  problem.settings.budget_s = 700;
  const JointFit fit = fit_jointly(problem, fake::study(problem, true));
  EXPECT_GT(fit.surrogates[3].failed_runs, 0);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("gave no reading")));
  for (const ParameterSet& set : fit.equivalence_family) {
    EXPECT_TRUE(set.values[4] < .65 || set.values[5] < .16);
  }
}

TEST(JointFit, IntervalsOfSeveralMaterialsHoldTheirTruths) {
  // A smoke test; tests/bench/recovery.cpp counts properly.
  const std::vector<std::vector<double>> truths = {
      {.25, .3, .03, .4, .6, .03}, {.5, .6, .12, .1, .2, .15}, {.4, .2, .08, .3, .4, .1}};
  int held = 0;
  for (std::size_t m = 0; m < truths.size(); ++m) {
    Problem problem = fake::problem(truths[m], 10 + m);
    problem.settings.budget_s = 700;
    const JointFit fit = fit_jointly(problem, fake::study(problem));
    for (std::size_t j = 0; j < 6; ++j) held += holds(fit.parameters[j], truths[m][j]);
  }
  EXPECT_GE(held, 16);  // of 18
}

}  // namespace
}  // namespace repose::calibrate
