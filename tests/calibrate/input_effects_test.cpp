#include "calibrate/fit/input_effects.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/experiment/run_store.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_run.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kHeight_mm = 400, kRelease_mm = 150, kSine = .342;

/// A ball rebounds to e^2 H; one rolls L sin(a) / c, by conservation of energy.
double reading(const Job& job) {
  const auto by = [&](const char* input) {
    return job.inputs.step.input == input ? job.inputs.step.change : 0;
  };
  if (job.experiment == "drop") return job.values[0] * job.values[0] * (kHeight_mm + by("height"));
  return (kRelease_mm + by("release")) * kSine / job.values[1];
}

/// Inside a gtest test, Run names something else.
using Runs = std::vector<Run>;

Run closed_form_run(const Job& job) {
  return {.job = job, .readings = {{"value", reading(job)}}, .failure = {}};
}

Parameter parameter(const char* name, double min, double max) {
  return {.name = name, .min = min, .max = max, .prior = {}};
}

Observable observable(const char* name, double mean) {
  Observable of;
  of.name = of.experiment = name;
  of.mean = mean;
  of.sd = 2;
  of.n = 10;
  return of;
}

Runs all(const std::vector<Job>& jobs) {
  Runs runs;
  for (const Job& job : jobs) runs.push_back(closed_form_run(job));
  return runs;
}

struct InputEffects : ::testing::Test {
  InputEffects() {
    problem_.parameters = {parameter("e", .2, .9), parameter("c", .2, 1)};
    problem_.experiments = {
        {.name = "drop", .parameters = {0}, .run_s = 1, .is_stochastic = false},
        {.name = "roll", .parameters = {1}, .run_s = 10, .is_stochastic = false}};
    problem_.observables = {observable("drop", 100), observable("roll", 102.6)};
    for (const auto& [name, of] : {std::pair("height", "drop"), {"release", "roll"}}) {
      problem_.fixed_inputs.push_back({.name = name,
                                       .unit = "mm",
                                       .value = 1,
                                       .sd = 2,
                                       .step = {.input = name, .change = 2},
                                       .experiments = {of}});
    }
    problem_.fixed_inputs.push_back({.name = "density",
                                     .unit = "kg/m3",
                                     .value = 1000,
                                     .sd = 20,
                                     .is_assumed = true,
                                     .step = {.input = "density", .change = 20},
                                     .experiments = {"drop", "roll"}});
    constexpr int kPoints = 16;
    for (int k = 0; k <= kPoints; ++k) {
      const double way = static_cast<double>(k) / kPoints;
      runs_.push_back(closed_form_run({.experiment = "drop", .values = {.2 + .7 * way, .6}}));
      runs_.push_back(closed_form_run({.experiment = "roll", .values = {.55, .2 + .8 * way}}));
    }
    checks_ = {{.experiment = "drop", .values = {.5, .6}},
               {.experiment = "roll", .values = {.55, .5}}};
  }

  Problem problem_;
  Runs runs_;
  std::vector<Job> checks_;
};

// de = -e dH / (2 H) and dc = c dL / L, by differentiation at one reading.
TEST_F(InputEffects, AreThoseOfClosedForms) {
  const JointFit fit = fit_jointly(problem_, runs_);
  const InputPlan plan = plan_inputs(problem_, checks_);
  ASSERT_THAT(plan.jobs, SizeIs(4));
  EXPECT_EQ(plan.run_s, 22);
  const auto effects = effects_of_inputs(problem_, plan, all(checks_), all(plan.jobs), fit, runs_);
  ASSERT_THAT(effects, SizeIs(3));
  const double e = std::sqrt(100 / kHeight_mm), c = kRelease_mm * kSine / 102.6;
  EXPECT_NEAR(effects[0].readings.at(0).change, .25 * 2, 1e-9);
  EXPECT_NEAR(effects[0].coefficients.at(0).change, -e * 2 / (2 * kHeight_mm), 5e-5);
  EXPECT_NEAR(effects[0].coefficients.at(1).change, 0, 5e-5) << "no drop tells it";
  EXPECT_NEAR(effects[1].coefficients.at(1).change, c * 2 / kRelease_mm, 2e-4);
  EXPECT_EQ(effects[2].readings.at(0).change, 0);
  EXPECT_NEAR(effects[2].coefficients.at(0).change, 0, 1e-9);
  const auto combined = combined_effects(problem_, fit, effects);
  ASSERT_THAT(combined, SizeIs(2));
  EXPECT_NEAR(combined[0].effect, 1.96 * e * 2 / (2 * kHeight_mm), 1e-4);
  const Interval own = fit.parameters[0].interval;
  EXPECT_LT(combined[0].interval.low, own.low);
  EXPECT_NEAR(combined[0].interval.low,
              combined[0].value - std::hypot(combined[0].value - own.low, combined[0].effect),
              1e-12);
  EXPECT_NEAR(combined[0].half_width, (own.high - own.low) / 2, 1e-12);
}

TEST_F(InputEffects, AStepDownSaysWhatMoreWouldDo) {
  problem_.fixed_inputs = {problem_.fixed_inputs[0]};
  problem_.fixed_inputs[0].step.change = -2;
  const InputPlan plan = plan_inputs(problem_, checks_);
  const auto effects = effects_of_inputs(problem_, plan, all(checks_), all(plan.jobs),
                                         fit_jointly(problem_, runs_), runs_);
  EXPECT_NEAR(effects[0].readings.at(0).change, .25 * 2, 1e-9);
}

TEST_F(InputEffects, WhatAFifthOfTheBudgetDoesNotAllowForIsNamed) {
  problem_.settings.budget_s = 100;
  const InputPlan plan = plan_inputs(problem_, checks_);
  EXPECT_THAT(plan.jobs, SizeIs(3)) << "both of 1 s, and one of 10";
  EXPECT_THAT(plan.inputs[0].not_varied, IsEmpty());
  EXPECT_THAT(plan.inputs[2].not_varied, ElementsAre("roll"));
}

TEST_F(InputEffects, ByChanceEachRunIsComparedWithThatOfItsSeed) {
  problem_.experiments[0].is_stochastic = true;
  problem_.fixed_inputs = {problem_.fixed_inputs[0]};
  Runs checks, varied;
  for (int k = 0; k < 24; ++k) {
    checks.push_back(
        closed_form_run({.experiment = "drop", .values = {.5, .6}, .seed = 1000000000U + k}));
    checks.back().readings["value"] += k * k;  // much more scatter than the effect of the change
  }
  problem_.settings.budget_s = 50;
  std::vector<Job> jobs;
  for (const auto& run : checks) jobs.push_back(run.job);
  const InputPlan plan = plan_inputs(problem_, jobs);
  ASSERT_THAT(plan.jobs, SizeIs(10)) << "a fifth of 50 s";
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(plan.jobs[k].seed, jobs[k].seed);
    varied.push_back(closed_form_run(plan.jobs[k]));
    varied.back().readings["value"] += k * k + (k % 2 == 0 ? .1 : -.1);
  }
  const auto effects =
      effects_of_inputs(problem_, plan, checks, varied, fit_jointly(problem_, runs_), runs_);
  EXPECT_NEAR(effects[0].readings.at(0).change, .5, 1e-9);
  EXPECT_NEAR(effects[0].readings.at(0).uncertainty, .1 * std::sqrt(10. / 9) / std::sqrt(10), 1e-9);
  // du = e du_y / (2 y), y = e^2 H
  EXPECT_NEAR(effects[0].coefficients.at(0).uncertainty,
              effects[0].readings.at(0).uncertainty * .5 / 200, 3e-6);
}

struct VariedStudy : ::testing::Test {
  std::optional<StudyOutcome> run(const std::vector<std::string>& settings) const {
    const dem::Study study =
        dem::read_study(folder_.write("study.toml", test::kSphereStudy), settings);
    const dem::ClumpFile grain = dem::build_grain(study.grain);
    Problem problem = problem_of(study, grain, budget_named("quick")).problem;
    problem.settings.max_jobs = 24;
    problem.settings.max_rounds = 3;
    Budget budget = budget_named("quick");
    budget.family_sets = 0;
    StudySimulator simulator(study, grain, problem.parameters, 0);
    const RunStore runs(folder_.path() / "runs");
    simulator.store_in(runs);
    ThreadExecutor executor(simulator, 2);
    const std::atomic<bool> is_interrupted = false;
    return run_study(problem, budget, {simulator, runs, executor, is_interrupted});
  }
  repose::testing::TemporaryFolder folder_;
};

const InputEffect& effect_of(const StudyOutcome& outcome, const std::string& input) {
  return *std::ranges::find(outcome.inputs, input, &InputEffect::input);
}

TEST_F(VariedStudy, SaysWhatHeightAndDensityMove) {
  const auto outcome = run({"uncertainty.experiment.drop.height_mm = 2"});
  ASSERT_TRUE(outcome);
  const double e = outcome->fit.parameters[0].value;
  const InputEffect& height = effect_of(*outcome, "experiment.drop.height_mm");
  EXPECT_NEAR(height.coefficients.at(0).change, -e * 2 / (2 * 100), .0015);
  EXPECT_NEAR(height.coefficients.at(1).change, 0, 1e-3);
  const InputEffect& density = effect_of(*outcome, "particle.density_kg_m3");
  ASSERT_THAT(density.readings, SizeIs(2));
  EXPECT_NEAR(density.readings[1].change, 0, .02) << "an angle of sliding, degrees";
  for (const InputEffect& one : outcome->inputs) EXPECT_THAT(one.not_varied, IsEmpty());
  for (const auto& known : outcome->runs) {
    EXPECT_EQ(known.job.inputs, AssumedInputs{}) << "none is fitted";
  }
  const auto without = run({"uncertainty.vary = false"});
  ASSERT_TRUE(without);
  EXPECT_THAT(without->inputs, IsEmpty());
  EXPECT_EQ(without->fit.parameters[0].value, e) << "the same fit";
  EXPECT_EQ(without->simulated, 0) << "of the same runs";
}

TEST_F(VariedStudy, WarnsWhereItIsMoreThanTheInterval) {
  const auto outcome = run({"uncertainty.experiment.drop.height_mm = 40"});
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->notes, Contains(HasSubstr("restitution: inputs that were held fixed")));
}

}  // namespace
}  // namespace repose::calibrate
