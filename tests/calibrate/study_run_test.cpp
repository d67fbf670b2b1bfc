#include "calibrate/study/study_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_problem.h"
#include "tests/calibrate/sphere_study_test.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class StudyRun : public test::SphereStudyTest {
 protected:
  static Budget budget() {
    Budget budget = budget_named("quick");
    budget.family_sets = 1;
    return budget;
  }

  /// The outcome of a study run in a folder, interrupted at progress report number `stop`.
  std::optional<StudyOutcome> run(const std::string& folder, int threads, int stop = -1,
                                  const std::vector<std::string>& settings = {}) const {
    const dem::Study study = read(settings);
    StudySimulator simulator = simulator_of(study);
    const RunStore runs(folder_.path() / folder);
    simulator.store_in(runs);
    ThreadExecutor executor(simulator, threads);
    std::atomic<bool> is_interrupted = false;
    int told = 0;
    const auto report = [&](const StudyProgress&) {
      is_interrupted = is_interrupted || ++told == stop;
    };
    return run_study(small_problem(study), budget(),
                     {simulator, runs, executor, is_interrupted, report});
  }

  static std::vector<double> numbers(const StudyOutcome& outcome) {
    std::vector<double> all;
    for (const FittedParameter& parameter : outcome.fit.parameters) {
      all.insert(all.end(), {parameter.value, parameter.interval.low, parameter.interval.high});
    }
    for (const Agreement& agreement : outcome.best.observables) all.push_back(agreement.simulated);
    return all;
  }
};

TEST_F(StudyRun, WhatIsHeldOutIsPredictedAndNotFitted) {
  const dem::Study study = read({"experiment.tilt.held_out = true"});
  const Problem problem = small_problem(study);
  ASSERT_THAT(problem.observables, SizeIs(1));
  ASSERT_THAT(problem.held_out, SizeIs(1));
  EXPECT_EQ(problem.held_out[0].name, "tilt");
  const auto outcome = run("held_out", 2, -1, {"experiment.tilt.held_out = true"});
  ASSERT_TRUE(outcome);
  ASSERT_THAT(outcome->fit.observables, SizeIs(1));
  ASSERT_THAT(outcome->predictions, SizeIs(1));
  const Prediction& tilt = outcome->predictions[0];
  EXPECT_EQ(tilt.name, "tilt");
  EXPECT_EQ(tilt.sets, 8);
  EXPECT_LT(tilt.interval.low, 20.475) << "nothing tells the friction";
  EXPECT_GT(tilt.interval.high, 20.475);
  EXPECT_EQ(tilt.verdict, AgreementVerdict::cannot_tell);
  EXPECT_THAT(outcome->fit.parameters[1].advice, HasSubstr("fit the tilt experiment too"));
}

TEST_F(StudyRun, SoftenedExperimentsAreSimulatedWithStifferGrainsAtTheEnd) {
  const std::vector<std::string> softened = {"experiment.drop.stiffness_factor = 0.25"};
  const Problem problem = small_problem(read(softened));
  EXPECT_EQ(problem.experiments[0].real_stiffness, 4);
  EXPECT_EQ(problem.experiments[1].real_stiffness, 1);
  const auto outcome = run("softened", 2, -1, softened);
  ASSERT_TRUE(outcome);
  ASSERT_THAT(outcome->stiffness.readings, SizeIs(1));
  const SensitivityCheck& drop = outcome->stiffness.readings[0];
  EXPECT_EQ(drop.name, "drop");
  EXPECT_EQ(drop.multiple, 4) << "as stiff as real grains, no stiffer";
  EXPECT_EQ(drop.runs, 24);
  EXPECT_LT(std::abs(drop.change), .5) << "restitution does not depend on stiffness";
  EXPECT_EQ(drop.verdict, AgreementVerdict::agrees);
  for (const auto& known : outcome->runs)
    EXPECT_EQ(known.job.inputs.stiffness, 1) << "none is fitted";
  EXPECT_THAT(run("real", 2)->stiffness.readings, IsEmpty());
}

TEST_F(StudyRun, WhereTheBudgetAllowsForNoStifferGrainsThatIsSaid) {
  const dem::Study study = read({"experiment.drop.stiffness_factor = 0.25"});
  Problem problem = small_problem(study);
  problem.settings.budget_s = .1;
  Budget many = budget();
  StudySimulator simulator = simulator_of(study);
  const RunStore runs(folder_.path() / "dear");
  ThreadExecutor executor(simulator, 2);
  const std::atomic<bool> is_interrupted = false;
  const auto outcome = run_study(problem, many, {simulator, runs, executor, is_interrupted});
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->stiffness.readings, IsEmpty());
  EXPECT_THAT(outcome->notes,
              Contains(AllOf(HasSubstr("drop: it is not known what its stiffness_factor"),
                             HasSubstr("Fix: the budget standard"))));
  many.settings.budget_s = budget_named("standard").settings.budget_s;
  const auto standard = run_study(problem, many, {simulator, runs, executor, is_interrupted});
  ASSERT_TRUE(standard);
  EXPECT_THAT(standard->notes, Contains(HasSubstr("Fix: simulate it at these coefficients")));
}

const std::vector<std::string> kClump = {"particle.size_mm = [22, 18, 16]", "particle.spheres = 2"};

TEST_F(StudyRun, AClumpIsSimulatedWithFourTimesTheSpheresAtTheEnd) {
  const auto outcome = run("clump", 2, -1, kClump);
  ASSERT_TRUE(outcome);
  const ShapeCheck& shape = outcome->shape;
  EXPECT_THAT(shape.not_made, IsEmpty());
  EXPECT_EQ(shape.spheres, 2);
  EXPECT_EQ(shape.finer_spheres, 8);
  EXPECT_LT(shape.finer_volume_error, grain_of(read(kClump)).errors.volume_error);
  ASSERT_THAT(shape.readings, SizeIs(2));
  EXPECT_EQ(shape.readings[0].name, "drop");
  EXPECT_EQ(shape.readings[0].runs, 24);
  EXPECT_GT(shape.readings[0].uncertainty, 0);
  EXPECT_EQ(shape.readings[1].runs, 1) << "a plate tilts without chance";
  EXPECT_THAT(shape.coefficients, SizeIs(2));
  for (const auto& known : outcome->runs) {
    EXPECT_EQ(known.job.inputs, AssumedInputs{}) << "none is fitted";
  }
  const auto again = run("clump", 2, -1, kClump);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->simulated, 0) << "the folder has them all";
  EXPECT_EQ(again->shape.readings[0].change, shape.readings[0].change);
}

TEST_F(StudyRun, WhereMoreSpheresAreNotSimulatedItIsSaidWhy) {
  const auto why = [&](const dem::Study& study, const dem::ClumpFile& grain) {
    return problem_of(study, grain, budget_named("quick")).problem.spheres.no_closer;
  };
  const dem::Study ball = read();
  EXPECT_THAT(why(ball, grain_of(ball)), HasSubstr("one sphere is exactly the shape"));
  const dem::Study study = read(kClump);
  dem::ClumpFile grain = grain_of(study);
  EXPECT_THAT(why(study, grain), IsEmpty());
  grain.shape.spheres.resize(dem::kMaxSpheres, grain.shape.spheres[0]);
  EXPECT_THAT(why(study, grain), HasSubstr("more than 200 spheres are not made"));
  dem::Study of_file = study;
  of_file.grain.clump = "grain.json";
  EXPECT_THAT(why(of_file, grain_of(study)), HasSubstr("a clump file has its spheres"));
}

TEST_F(StudyRun, AClumpThatCannotHaveMoreSpheresIsNamedAndDoesNotStopTheStudy) {
  dem::Study study = read(kClump);
  const dem::ClumpFile& grain = grain_of(study);
  const Problem problem = small_problem(study);
  study.grain.sizes.reset();  // like a scan that was moved away in the meantime
  StudySimulator simulator(study, grain, problem.parameters, 0);
  const RunStore runs(folder_.path() / "moved");
  simulator.store_in(runs);
  ThreadExecutor executor(simulator, 2);
  const std::atomic<bool> is_interrupted = false;
  const auto outcome = run_study(problem, budget(), {simulator, runs, executor, is_interrupted});
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->shape.not_made,
              AllOf(HasSubstr("more spheres cannot be made"), HasSubstr("has no shape")));
  EXPECT_THAT(outcome->shape.readings, IsEmpty());
  Problem slow = problem;
  for (Experiment& experiment : slow.experiments) experiment.spheres_share = 1e6;
  const auto dear = run_study(slow, budget(), {simulator, runs, executor, is_interrupted});
  ASSERT_TRUE(dear);
  EXPECT_THAT(dear->shape.over_budget, ElementsAre("drop", "tilt"));
  EXPECT_THAT(dear->notes, Contains(HasSubstr("drop: it is not known what its number of spheres")));
}

TEST_F(StudyRun, ABallThatIsDroppedHasNoChanceAndIsGivenNone) {
  const auto outcome = run("runs", 2);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->fit.observables[0].simulated_sd, 0);
  // Student's interval of five rebounds, 25 mm with an sd of 1 mm, by e = sqrt(h / H).
  const double half_mm = 2.776445 / std::sqrt(5);
  const Interval& interval = outcome->fit.parameters[0].interval;
  EXPECT_NEAR(interval.high - interval.low,
              std::sqrt((25 + half_mm) / 100) - std::sqrt((25 - half_mm) / 100), .001);
}

TEST_F(StudyRun, ABenchThatCannotResolveItsMarginCannotTell) {
  const auto outcome =
      run("sloppy", 2, -1, {"experiment.drop.measured = { mean = 25, sd = 15, n = 3 }"});
  ASSERT_TRUE(outcome);
  const Agreement& drop = outcome->best.observables[0];
  EXPECT_EQ(drop.verdict, AgreementVerdict::cannot_tell);
  EXPECT_NEAR(drop.tolerance, 2.5, .01) << "a tenth of the reading, however sure it is";
  ASSERT_TRUE(drop.readings_to_decide);
  EXPECT_GT(*drop.readings_to_decide, 200);
  EXPECT_LT(outcome->fit.freedom.degrees, .01);
}

/// Two drop heights show how restitution depends on speed: 100 and 4 mm are fivefold in speed.
TEST_F(StudyRun, TwoHeightsGiveRestitutionAndItsExponentBack) {
  const double e0 = .5, exponent = .12;
  const auto rebound_mm = [&](double height_mm) {
    const double speed = std::sqrt(2 * 9.80665 * height_mm / 1000);
    return height_mm * std::pow(e0 * std::pow(speed / 1.4, -exponent), 2);
  };
  const auto outcome = run(
      "speeds", 2, -1,
      {"particle.young_modulus_pa = 1e8",  // so stiff that its weight does not matter
       "contact.particle_wall.restitution_exponent = { min = 0, max = 0.25 }",
       "contact.particle_wall.restitution_speed_m_s = 1.4",
       "contact.particle_wall.sliding_friction = 0.4", "experiment.drop.low_height_mm = 4",
       fmt::format("experiment.drop.measured = {{ mean = {}, sd = 0.3, n = 10, in_air = false }}",
                   rebound_mm(100)),
       fmt::format("experiment.drop.also_measured.low_rebound_mm = {{ mean = {}, sd = 0.02, n = 10 "
                   "}}",
                   rebound_mm(4))});
  ASSERT_TRUE(outcome);
  ASSERT_THAT(outcome->fit.parameters, SizeIs(2));
  EXPECT_NEAR(outcome->fit.parameters[0].value, e0, .01);
  EXPECT_EQ(outcome->fit.parameters[1].name, "contact.particle_wall.restitution_exponent");
  EXPECT_NEAR(outcome->fit.parameters[1].value, exponent, .02);
  EXPECT_EQ(outcome->fit.parameters[1].verdict, Verdict::determined);
}

TEST_F(StudyRun, FindsTheCoefficientsOfTheBench) {
  const auto outcome = run("runs", 2);
  ASSERT_TRUE(outcome);
  const FittedParameter& restitution = outcome->fit.parameters[0];
  EXPECT_NEAR(restitution.value, std::sqrt(25. / 100), .05) << "e = sqrt(h / H)";
  EXPECT_LT(restitution.interval.low, restitution.value);
  EXPECT_GT(restitution.interval.high, restitution.value);
  EXPECT_NEAR(outcome->fit.parameters[1].value, std::tan(20.475 / 180 * 3.141592653589793), .01);
  EXPECT_EQ(outcome->best.verdict, AgreementVerdict::agrees);
  EXPECT_EQ(outcome->reused, 0);
}

TEST_F(StudyRun, EveryCheckEntersTheFitWhetherItAgreesOrNot) {
  for (const char* tilted : {"20.5", "70"}) {  // the second is unreachable
    const auto outcome =
        run("runs", 2, -1,
            {fmt::format("experiment.tilt.measured = {{ mean = {}, sd = 1, n = 4 }}", tilted)});
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->best.verdict,
              tilted == std::string("70") ? AgreementVerdict::disagrees : AgreementVerdict::agrees);
    EXPECT_GE(outcome->check_rounds, 1);
    ASSERT_THAT(outcome->checks, Not(IsEmpty()));
    for (const auto& check : outcome->checks) {
      EXPECT_TRUE(std::any_of(outcome->runs.begin(), outcome->runs.end(),
                              [&](const auto& known) { return known.job == check.job; }));
      EXPECT_TRUE(check.job.experiment == "tilt" || check.job.seed >= 1'000'000'000U);
    }
    // The reported fit includes all of them, and the final check is at coefficients close to it.
    EXPECT_EQ(
        fit_jointly(small_problem(read({fmt::format(
                        "experiment.tilt.measured = {{ mean = {}, sd = 1, n = 4 }}", tilted)})),
                    outcome->runs)
            .chi2,
        outcome->fit.chi2);
    EXPECT_NEAR(outcome->best.values[1], outcome->fit.parameters[1].value, .01);
  }
}

TEST_F(StudyRun, ChecksAreFewRunsWhileTheyMoveTheFitAndManyAtTheEnd) {
  const auto outcome = run("runs", 2);
  ASSERT_TRUE(outcome);
  std::map<double, int> drops;  // by restitution: only those with the seeds of checks
  for (const auto& known : outcome->runs) {
    const bool is_check = known.job.seed >= 1'000'000'000U;
    if (is_check && known.job.experiment == "drop") ++drops[known.job.values[0]];
  }
  const double last = outcome->best.values[0];
  EXPECT_EQ(drops.at(last), 24);
  EXPECT_EQ(outcome->best.observables[0].runs, 24);
  drops.erase(last);
  EXPECT_EQ(std::ranges::count(drops, 6, &std::pair<const double, int>::second),
            outcome->check_rounds - 1);
  std::set<std::uint64_t> seeds;
  for (const auto& check : outcome->checks) {
    if (check.job.experiment == "drop") seeds.insert(check.job.seed);
  }
  EXPECT_THAT(seeds, SizeIs(24)) << "all different";
}

TEST_F(StudyRun, IsTheSameWithAnyNumberOfThreadsAndInterruptions) {
  const auto whole = run("whole", 1);
  ASSERT_TRUE(whole);
  for (const int stop : {2, 9, 14}) EXPECT_FALSE(run("broken", 2, stop)) << stop;
  const auto broken = run("broken", 2);
  ASSERT_TRUE(broken);
  EXPECT_EQ(numbers(*broken), numbers(*whole));
  EXPECT_GT(broken->reused, 10);
  EXPECT_EQ(broken->reused + broken->simulated, whole->simulated);
}

TEST_F(StudyRun, DamagedFilesAreSimulatedAgain) {
  const auto first = run("runs", 2);
  ASSERT_TRUE(first);
  int damaged = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "runs" / "runs")) {
    if (++damaged > 3) break;
    std::filesystem::resize_file(entry.path(), damaged == 1 ? 0 : 40);
  }
  const auto again = run("runs", 2);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->simulated, 3);
  EXPECT_EQ(numbers(*again), numbers(*first));
}

TEST_F(StudyRun, AnExperimentWithoutAReadingIsAFailedRunNotAnError) {
  const dem::Study study = read({"contact.particle_wall.rolling_friction=0"});
  const std::atomic<bool> is_interrupted = false;
  const Job job{.experiment = "tilt", .values = {.5, 90.}, .seed = 1};
  const auto found = run_of(job, simulator_of(study).simulate(job, is_interrupted));
  EXPECT_THAT(found.readings, IsEmpty());
  EXPECT_THAT(found.failure, HasSubstr("instead of sliding"));
}

/// Like a faulty machine: the first drop rebounds to `rebound_mm`.
class WrongExecutor : public Executor {
 public:
  WrongExecutor(const StudySimulator& simulator, double rebound_mm)
      : right_(simulator, 2), rebound_mm_(rebound_mm) {}
  int workers() const override { return right_.workers(); }
  void run(const std::vector<Job>& jobs, const JobDone& done,
           const std::atomic<bool>& is_interrupted) override {
    right_.run(
        jobs,
        [&](std::size_t k, RunResult result) {
          if (jobs[k].experiment == "drop" && jobs[k].seed == 1) result.value = rebound_mm_;
          done(k, result);
        },
        is_interrupted);
  }

 private:
  ThreadExecutor right_;
  double rebound_mm_;
};

TEST_F(StudyRun, AReadingThatCannotBeCountsAsAFailedRunAndIsNamed) {
  const dem::Study study = read();
  const StudySimulator simulator = simulator_of(study);
  for (const auto& [name, rebound_mm] : {std::pair("huge", 1e200), std::pair("high", 200.)}) {
    const RunStore runs(folder_.path() / name);  // the ball falls from 100 mm
    WrongExecutor executor(simulator, rebound_mm);
    const std::atomic<bool> is_interrupted = false;
    const auto outcome =
        run_study(small_problem(study), budget(), {simulator, runs, executor, is_interrupted});
    ASSERT_TRUE(outcome);
    const auto failed = std::find_if(
        outcome->runs.begin(), outcome->runs.end(),
        [](const auto& run) { return run.job.experiment == "drop" && run.job.seed == 1; });
    ASSERT_NE(failed, outcome->runs.end());
    EXPECT_THAT(failed->failure, HasSubstr("its rebound height is"));
    EXPECT_THAT(failed->readings, IsEmpty());
    EXPECT_THAT(runs.remarks(), Contains(AllOf(HasSubstr("drop with seed 1: its rebound height is"),
                                               HasSubstr("at most 119.99"), HasSubstr("Fix:"))));
  }
}

TEST_F(StudyRun, AFolderThatCannotBeMadeIsRefused) {
  folder_.write("file", std::string("x"));
  EXPECT_THROW(RunStore(folder_.path() / "file"), base::InputError);
}

}  // namespace
}  // namespace repose::calibrate
