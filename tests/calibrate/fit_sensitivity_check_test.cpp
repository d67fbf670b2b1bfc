#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/fit/prediction.h"
#include "calibrate/fit/sensitivity_check.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using fake::experiment_of;
using fake::kTruth;

/// Everything measured; in one experiment the real grains are stiffer than those of the study.
Problem softening(const std::string& experiment, double real_stiffness = 1000,
                  std::uint64_t seed = 1) {
  Problem problem = fake::problem(kTruth, seed);
  problem.settings.budget_s = 1e6;
  experiment_of(problem, experiment).real_stiffness = real_stiffness;
  return problem;
}

void hold_out(const std::string& experiment, Problem& problem) {
  for (const Observable& observable : problem.observables) {
    if (observable.experiment == experiment) problem.held_out.push_back(observable);
  }
  std::erase_if(problem.observables,
                [&](const Observable& observable) { return observable.experiment == experiment; });
}

/// As much of a fit as a check needs, without the scatter of runs.
JointFit fit_for_check(const Problem& problem) {
  JointFit fit;
  for (const Observable& observable : problem.observables) {
    FittedObservable& fitted = fit.observables.emplace_back();
    fitted.measured_uncertainty = standard_uncertainty(observable);
    fit.surrogates.emplace_back().runs = 2;
  }
  return fit;
}

SensitivityPlan plan_stiffer(const Problem& problem, const std::vector<double>& values,
                             int repeats) {
  return plan_sensitivity(problem, AssumedInput::stiffness, values, repeats);
}

std::vector<SensitivityCheck> checks_of(const Problem& problem, int repeats) {
  fake::Runs runs = fake::run_all(plan_stiffer(problem, kTruth, repeats).jobs);
  for (Run& run : fake::run_all(verification_jobs(problem, kTruth, repeats, 0))) {
    runs.push_back(std::move(run));
  }
  return check_sensitivity(problem, AssumedInput::stiffness, kTruth, runs, fit_for_check(problem));
}

TEST(StiffnessCheck, OnlySoftenedExperimentsAreSimulatedTenTimesStiffer) {
  EXPECT_THAT(plan_stiffer(fake::problem(kTruth, 1), kTruth, 6).jobs, IsEmpty());
  const SensitivityPlan plan = plan_stiffer(softening("heap"), kTruth, 6);
  ASSERT_THAT(plan.jobs, SizeIs(6));
  std::set<std::uint64_t> seeds;
  for (const Job& job : plan.jobs) {
    EXPECT_EQ(job.experiment, "heap");
    EXPECT_EQ(job.inputs.stiffness, 10);
    EXPECT_EQ(job.values, kTruth);
    seeds.insert(job.seed);
  }
  EXPECT_THAT(seeds, SizeIs(6));
  EXPECT_NEAR(plan.run_s, 6 * 25 * std::pow(10, .4), 1e-9) << "a step is shorter by as much";
}

TEST(StiffnessCheck, NoGrainIsStifferThanTheRealOnes) {
  const SensitivityPlan plan = plan_stiffer(softening("tilt", 4), kTruth, 6);
  ASSERT_THAT(plan.jobs, SizeIs(1)) << "without chance one run is enough";
  EXPECT_EQ(plan.jobs[0].inputs.stiffness, 4);
}

TEST(StiffnessCheck, SeedsAreThoseOfNoOtherRun) {
  Problem problem = softening("heap");
  std::set<std::uint64_t> taken;
  for (int set = 0; set < 12; ++set) {
    for (const Job& job : verification_jobs(problem, kTruth, 8, set)) taken.insert(job.seed);
  }
  hold_out("heap", problem);
  JointFit fit;
  fit.drawn.assign(kDrawnSets, kTruth);
  for (const Job& job : prediction_jobs(problem, fit)) taken.insert(job.seed);
  for (const Job& job : plan_stiffer(problem, kTruth, 6).jobs) {
    EXPECT_FALSE(taken.contains(job.seed));
  }
}

TEST(StiffnessCheck, WhatIsTooDearForTheBudgetIsNamedAndTheCheaperOnesAreSimulated) {
  Problem problem = softening("heap");
  experiment_of(problem, "roll").real_stiffness = 10;
  problem.settings.budget_s = 1000;
  const SensitivityPlan plan = plan_stiffer(problem, kTruth, 6);
  EXPECT_THAT(plan.over_budget, ElementsAre("heap"));
  ASSERT_THAT(plan.jobs, SizeIs(6));
  EXPECT_EQ(plan.jobs[0].experiment, "roll");
  EXPECT_THAT(check_sensitivity(problem, AssumedInput::stiffness, kTruth, fake::run_all(plan.jobs),
                                fit_for_check(problem)),
              SizeIs(1));
}

TEST(StiffnessCheck, WhereTimeIsShortThereAreFewerRepeatsButFiveAtLeast) {
  Problem problem = softening("heap");
  const double run_s = 25 * std::pow(10, .4);
  const auto jobs_within = [&](double seconds) {
    problem.settings.budget_s = seconds / .2;
    return plan_stiffer(problem, kTruth, 10).jobs.size();
  };
  EXPECT_EQ(jobs_within(10.5 * run_s), 10);
  EXPECT_EQ(jobs_within(7.5 * run_s), 7);
  EXPECT_EQ(jobs_within(5.5 * run_s), 5);
  EXPECT_EQ(jobs_within(4.5 * run_s), 0);
}

TEST(StiffnessCheck, IntervalsHoldTheChangeAsOftenAsTheySay) {
  constexpr int kStudies = 300;
  int held = 0, seen = 0;
  for (std::uint64_t seed = 1; seed <= kStudies; ++seed) {
    const auto checks = checks_of(softening("heap", 1000, 1000 * seed), 5);
    ASSERT_THAT(checks, SizeIs(1));
    const Interval& interval = checks[0].interval;
    held += interval.low <= -fake::kSofteningShift && -fake::kSofteningShift <= interval.high;
    seen += checks[0].verdict == AgreementVerdict::disagrees;
    EXPECT_NE(checks[0].verdict, AgreementVerdict::agrees) << "the change is five times the limit";
  }
  EXPECT_NEAR(held, .95 * kStudies, 12);
  EXPECT_GT(seen, .9 * kStudies) << "2.5 degrees, of which single heaps scatter by .7";
}

TEST(StiffnessCheck, WhatDoesNotChangeIsShownToBeWithinTheLimitOrCannotBeTold) {
  Problem problem = softening("roll");
  std::ranges::find(problem.observables, "roll", &Observable::name)->n = 40;
  EXPECT_EQ(checks_of(problem, 5).at(0).verdict, AgreementVerdict::cannot_tell);
  const SensitivityCheck check = checks_of(problem, 400).at(0);
  EXPECT_EQ(check.verdict, AgreementVerdict::agrees);
  EXPECT_EQ(check.runs, 400);
  EXPECT_GT(check.limit, check.interval.high);
}

TEST(StiffnessCheck, WithoutChanceTheChangeIsExact) {
  const SensitivityCheck check = checks_of(softening("tilt"), 5).at(0);
  EXPECT_EQ(check.change, 0);
  EXPECT_EQ(check.uncertainty, 0);
  EXPECT_EQ(check.verdict, AgreementVerdict::agrees);
}

TEST(StiffnessCheck, WhatIsHeldOutIsSimulatedAsStiffAsTheStudyToo) {
  Problem problem = softening("heap");
  hold_out("heap", problem);
  EXPECT_THAT(plan_stiffer(problem, kTruth, 6).jobs, SizeIs(12));
  const SensitivityCheck check = checks_of(problem, 6).at(0);
  EXPECT_EQ(check.name, "heap");
  EXPECT_NEAR(check.value, .01, 1e-12) << "ten times that of the study, 0.001";
  EXPECT_NEAR(check.change, -fake::kSofteningShift, 1.5);
}

TEST(StiffnessCheck, WhereHeapsAreDearLargerGrainsAreComparedWithLargerOnes) {
  Problem problem = softening("heap");
  fake::coarsen(problem, 2.5);
  const SensitivityPlan plan = plan_stiffer(problem, kTruth, 4);
  std::size_t stiffer = 0;
  for (const Job& job : plan.jobs) {
    EXPECT_EQ(job.inputs.size, 2.5);
    stiffer += job.inputs.stiffness == 10 ? 1 : 0;
  }
  EXPECT_EQ(2 * stiffer, plan.jobs.size());
  EXPECT_EQ(stiffer, 24) << "they are cheap, and scatter more";
  const SensitivityCheck check = checks_of(problem, 200).at(0);
  EXPECT_EQ(check.grain_size, 2.5);
  EXPECT_NEAR(check.change, -fake::kSofteningShift, .5) << "what size changes is in both";
  EXPECT_EQ(checks_of(softening("heap"), 4).at(0).grain_size, 1);
}

TEST(StiffnessCheck, AFewLargerGrainsThatAgreeByChanceAreNotTrustedOverTheirKind) {
  Problem problem = softening("heap");
  fake::coarsen(problem, 2.5);
  JointFit fit = fit_for_check(problem);
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    if (problem.observables[i].name != "heap") continue;
    fit.observables[i].simulated_sd = 1;
    fit.surrogates[i].runs = 52;
    fit.surrogates[i].coarse = CoarseQuality{.size = 2.5, .runs = 50, .scatter = 3};
  }
  fake::Runs runs = fake::run_all(plan_stiffer(problem, kTruth, 4).jobs);
  for (auto& run : runs) run.readings["value"] = 20 + 1e-3 * static_cast<double>(run.job.seed % 2);
  const auto check = check_sensitivity(problem, AssumedInput::stiffness, kTruth, runs, fit).at(0);
  EXPECT_NEAR(check.uncertainty, 3 * std::sqrt(2. / 24), 1e-6);
}

TEST(StiffnessCheck, LargerGrainsThatGiveNoReadingSayNothingOfTheStudys) {
  Problem problem = softening("heap");
  fake::coarsen(problem, 2.5);
  fake::Runs runs = fake::run_all(plan_stiffer(problem, kTruth, 4).jobs);
  for (auto& run : runs) {
    if (run.job.inputs.stiffness != 1) run = {run.job, {}, "no heap"};
  }
  const auto check =
      check_sensitivity(problem, AssumedInput::stiffness, kTruth, runs, fit_for_check(problem));
  EXPECT_EQ(check.at(0).verdict, AgreementVerdict::cannot_tell);
}

TEST(ShapeCheck, RunsThatWereMadeForStifferGrainsAreNotMadeAgain) {
  Problem problem = softening("heap");
  fake::coarsen(problem, 2.5);
  problem.spheres = {.count = 11, .most = 200, .no_closer = {}};
  const SensitivityPlan stiffer = plan_stiffer(problem, kTruth, 4);
  const auto heaps = [&](const std::vector<Job>& made) {
    return std::ranges::count(
        plan_sensitivity(problem, AssumedInput::spheres, kTruth, 4, made).jobs, "heap",
        &Job::experiment);
  };
  EXPECT_EQ(heaps({}), 48);
  EXPECT_EQ(heaps(stiffer.jobs), 24);
}

TEST(StiffnessCheck, StifferGrainsThatGiveNoReadingDisagree) {
  const Problem problem = softening("heap");
  fake::Runs runs = fake::run_all(verification_jobs(problem, kTruth, 5, 0));
  for (const Job& job : plan_stiffer(problem, kTruth, 5).jobs) {
    runs.push_back({job, {}, "the grains stay in the tube"});
  }
  const SensitivityCheck never =
      check_sensitivity(problem, AssumedInput::stiffness, kTruth, runs, fit_for_check(problem))
          .at(0);
  EXPECT_EQ(never.verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(never.failed_runs, 5);
  EXPECT_TRUE(std::isnan(never.change));
}

TEST(StiffnessCheck, RealGrainsAreNoSofterThanTheStudys) {
  const Problem problem = softening("heap", .5);
  EXPECT_THAT(error_of([&] { require_sound(problem); }), HasSubstr("real_stiffness = 0.5"));
}

/// Everything measured; the grain has eleven of the 200 spheres that could follow its surface.
Problem of_a_clump(int spheres = 11) {
  Problem problem = fake::problem(kTruth, 1);
  problem.settings.budget_s = 1e6;
  problem.spheres = {.count = spheres, .most = 200, .no_closer = {}};
  return problem;
}

std::vector<SensitivityCheck> shape_checks_of(const Problem& problem, fake::Runs runs,
                                              int repeats) {
  for (Run& run :
       fake::run_all(plan_sensitivity(problem, AssumedInput::spheres, kTruth, repeats).jobs)) {
    runs.push_back(std::move(run));
  }
  for (Run& run : fake::run_all(verification_jobs(problem, kTruth, repeats, 0))) {
    runs.push_back(std::move(run));
  }
  return check_sensitivity(problem, AssumedInput::spheres, kTruth, runs, fit_for_check(problem));
}

TEST(ShapeCheck, EveryMeasuredExperimentIsSimulatedWithFourTimesTheSpheres) {
  Problem problem = of_a_clump();
  experiment_of(problem, "heap").spheres_share = .4;
  const SensitivityPlan plan = plan_sensitivity(problem, AssumedInput::spheres, kTruth, 6);
  ASSERT_THAT(plan.jobs, SizeIs(3 * 6 + 1)) << "one tilt, which has no chance";
  for (const Job& job : plan.jobs) EXPECT_EQ(job.inputs, (AssumedInputs{1, 4}));
  EXPECT_NEAR(plan.run_s, 6 * (.6 + 1 + 25 * (1 + 3 * .4)) + .5, 1e-9);
}

TEST(ShapeCheck, NoClumpHasMoreSpheresThanThereCanBe) {
  const auto jobs_of = [](const Problem& problem) {
    return plan_sensitivity(problem, AssumedInput::spheres, kTruth, 6).jobs;
  };
  EXPECT_EQ(jobs_of(of_a_clump(80)).at(0).inputs.spheres, 2.5);
  EXPECT_THAT(jobs_of(of_a_clump(200)), IsEmpty());
  EXPECT_THAT(jobs_of(fake::problem(kTruth, 1)), IsEmpty()) << "a ball";
}

TEST(ShapeCheck, TellsWhichReadingsBelongToTheirClump) {
  const auto checks = shape_checks_of(of_a_clump(), {}, 24);
  ASSERT_THAT(checks, SizeIs(4));
  const SensitivityCheck& drop = checks[0];
  const double lost = (1 - fake::kFinerRebound) * fake::expected("drop", "value", kTruth);
  EXPECT_EQ(drop.value, 44);
  EXPECT_LE(drop.interval.low, -lost);
  EXPECT_GE(drop.interval.high, -lost);
  EXPECT_EQ(drop.verdict, AgreementVerdict::disagrees);
  EXPECT_EQ(checks[1].change, 0) << "a plate tilts";
  EXPECT_EQ(checks[1].verdict, AgreementVerdict::agrees);
  EXPECT_LT(std::abs(checks[3].change), 4 * checks[3].uncertainty) << "heaps are as they were";
}

TEST(ShapeCheck, IsNotMadeOfStifferGrains) {
  Problem problem = of_a_clump();
  experiment_of(problem, "heap").real_stiffness = 10;
  const auto checks =
      shape_checks_of(problem, fake::run_all(plan_stiffer(problem, kTruth, 24).jobs), 24);
  EXPECT_EQ(checks.at(3).runs, 24);
  EXPECT_LT(std::abs(checks.at(3).change), .8 * fake::kSofteningShift);
}

}  // namespace
}  // namespace repose::calibrate
