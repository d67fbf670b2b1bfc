#include "calibrate/study/study_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_estimate.h"
#include "calibrate/study/study_problem.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/roll.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class StudyRun : public ::testing::Test {
 protected:
  dem::Study read(const std::vector<std::string>& settings = {}) const {
    return dem::read_study(folder_.write("study.toml", test::kSphereStudy), settings);
  }

  /// Each is made once: that takes longer than most runs here.
  static const dem::ClumpFile& grain_of(const dem::Study& study) {
    static std::map<double, dem::ClumpFile> by_thickness;
    const auto [found, is_new] = by_thickness.try_emplace(study.grain.sizes->thickness_m);
    if (is_new) found->second = dem::build_grain(study.grain);
    return found->second;
  }

  static StudySimulator simulator_of(const dem::Study& study) {
    return {study, grain_of(study), small_problem(study).parameters, 0};
  }

  static Problem small_problem(const dem::Study& study) {
    Problem problem = problem_of(study, grain_of(study), budget_named("quick")).problem;
    problem.settings.max_jobs = 24;
    problem.settings.max_rounds = 3;
    return problem;
  }

  static Budget budget() {
    Budget budget = budget_named("quick");
    budget.family_sets = 1;
    return budget;
  }

  /// The fitted values of a study run in a folder; breaks it off before job number `stop`.
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

  TemporaryFolder folder_;
};

TEST_F(StudyRun, TakesItsProblemFromTheStudy) {
  const StudyProblem made = problem_of(read(), grain_of(read()), budget_named("quick"));
  ASSERT_THAT(made.problem.parameters, SizeIs(2));
  EXPECT_EQ(made.problem.parameters[0].name, "contact.particle_wall.restitution");
  EXPECT_EQ(made.problem.parameters[0].min, .2);
  EXPECT_THAT(made.problem.parameters[0].identified_by, ElementsAre("drop"));
  ASSERT_THAT(made.problem.observables, SizeIs(2));
  EXPECT_EQ(made.problem.observables[0].mean, 25);
  EXPECT_EQ(made.problem.observables[0].n, 5);
  EXPECT_NEAR(made.problem.observables[1].mean, 20.475, 1e-12);
  EXPECT_EQ(made.problem.observables[1].n, 4);
  ASSERT_THAT(made.problem.experiments, SizeIs(2));
  EXPECT_EQ(made.problem.observables[0].least, 0) << "no rebound is below the floor";
  EXPECT_EQ(made.problem.observables[1].most, 90);
  EXPECT_THAT(made.problem.experiments[1].parameters, ElementsAre(1)) << "friction alone";
  EXPECT_THAT(made.notes, IsEmpty());
}

const std::vector<std::string> kInclined = {
    "wall.incline = { young_modulus_pa = 1e7, poisson_ratio = 0.4 }",
    "contact.particle_incline = { restitution = 0.5, sliding_friction = { min = 0.1, max = 0.5 }, "
    "rolling_friction = 0.05 }",
    "experiment.roll = { measured = { mean = 100, sd = 5, n = 5 } }"};

TEST_F(StudyRun, CoefficientsOfAPartAreSoughtWhereTheBenchHasIt) {
  const dem::Study study = read(kInclined);
  const Problem problem = small_problem(study);
  ASSERT_THAT(problem.parameters, SizeIs(3));
  EXPECT_EQ(problem.parameters[2].name, "contact.particle_incline.sliding_friction");
  ASSERT_THAT(problem.experiments, SizeIs(3));
  EXPECT_THAT(problem.experiments[0].parameters, Not(Contains(2))) << "a drop is on the plate";
  EXPECT_THAT(problem.experiments[1].parameters, Not(Contains(2)));
  EXPECT_THAT(problem.experiments[2].parameters, Contains(2));
  const StudySimulator simulator = simulator_of(study);
  const std::vector<double> values = {.5, .4, .3};
  const RunSpec roll = simulator.spec({.experiment = "roll", .values = values, .seed = 1});
  EXPECT_EQ(roll.model.parts.at(dem::WallPart::incline).with_grain.sliding_friction, .3);
  EXPECT_THAT(simulator.spec({.experiment = "drop", .values = values, .seed = 1}).model.parts,
              IsEmpty());
}

// Runs in the store keep their names.
TEST_F(StudyRun, ARunIsNamedAfterThePartsOfItsBenchAlone) {
  const dem::Study plain = read({"experiment.roll = {}"}), inclined = read(kInclined);
  const auto text = [&](const dem::Study& study, dem::Experiment experiment) {
    static const NamedGrain grain(grain_of(plain));
    return description_of(spec_of(study, experiment, grain, 0), 1);
  };
  EXPECT_EQ(text(plain, dem::experiment_of<dem::DropProtocol>()),
            text(inclined, dem::experiment_of<dem::DropProtocol>()));
  EXPECT_THAT(text(plain, dem::experiment_of<dem::RollProtocol>()), Not(HasSubstr("incline\"")));
  EXPECT_THAT(text(inclined, dem::experiment_of<dem::RollProtocol>()),
              AllOf(HasSubstr(R"("incline":{"density_kg_m3":7850.0,"young_modulus_pa":10000000.0)"),
                    HasSubstr(R"("particle_incline":{"restitution":0.5)")));
}

TEST_F(StudyRun, SaysWhenTheDefinitionOfAHeapsAngleIsAssumed) {
  const std::string mean = "experiment.heap.measured={mean=23,sd=1,n=5}";
  const std::string rolling = "contact.particle_particle.rolling_friction={min=0,max=0.3}";
  const auto notes = [&](const std::vector<std::string>& settings) {
    const dem::Study study = read(settings);
    return problem_of(study, grain_of(study), budget_named("quick")).notes;
  };
  const auto is_said = Contains(
      AllOf(HasSubstr("[experiment.heap] does not say by which definition its angle was measured: "
                      "flank_20_80 is assumed"),
            HasSubstr("Fix: definition = ")));
  EXPECT_THAT(notes({mean, rolling}), is_said);
  for (const char* name : {"flank_20_80", "whole_flank"}) {
    EXPECT_THAT(notes({mean, rolling, fmt::format("experiment.heap.definition=\"{}\"", name)}),
                Not(is_said))
        << name;
  }
}

TEST_F(StudyRun, ALayerIsAFailedRunOfTheFit) {
  const dem::Study study = read({"experiment.heap={grains=12,lift_speed_mm_s=200}",
                                 "contact.particle_wall.rolling_friction=0.3"});
  const std::atomic<bool> is_interrupted = false;
  const Job job{.experiment = "heap", .values = {.5, .2}, .seed = 1};
  const auto found = run_of(job, simulator_of(study).simulate(job, is_interrupted));
  EXPECT_THAT(found.readings, IsEmpty());
  EXPECT_THAT(found.failure, AllOf(HasSubstr("spread to a layer"), HasSubstr("Fix: ")));
}

TEST_F(StudyRun, AnUnknownScatterIsAssumed) {
  const dem::Study study = read({"experiment.drop.measured = { mean = 25, n = 5 }"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.observables[0].assumed_sd_fraction,
            dem::experiment_of<dem::DropProtocol>()->usual_scatter);
}

TEST_F(StudyRun, ADropIsTheMeanOfItsGrains) {
  const dem::Study study = read({"experiment.drop.grains = 7"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.experiments[0].readings_per_run, 7);
  EXPECT_EQ(made.problem.experiments[1].readings_per_run, 1);
}

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
  study.grain.sizes.reset();  // as a scan that was moved away meanwhile
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

TEST_F(StudyRun, SomethingMustBeLeftToFit) {
  const dem::Study study =
      read({"experiment.tilt.held_out = true", "experiment.drop.held_out = true"});
  EXPECT_THAT(error_of([&] { problem_of(study, grain_of(study), budget_named("quick")); }),
              HasSubstr("has readings, but for those held out"));
}

TEST_F(StudyRun, TheToleranceIsTheStudys) {
  const dem::Study study = read({"experiment.drop.measured = { mean = 25, n = 5, tolerance = 3 }"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.observables[0].tolerance, 3);
  EXPECT_FALSE(made.problem.observables[1].tolerance);
}

TEST_F(StudyRun, StudiesInWhichNothingCanBeFoundAreRefused) {
  const auto refusal = [&](const std::vector<std::string>& settings) {
    const dem::Study study = read(settings);
    return error_of([&] { problem_of(study, grain_of(study), budget_named("quick")); });
  };
  EXPECT_THAT(refusal({"contact.particle_wall.restitution=0.5",
                       "contact.particle_wall.sliding_friction=0.5"}),
              HasSubstr("there is nothing to fit"));
  EXPECT_THAT(refusal({"contact.particle_wall.restitution=0.5",
                       "contact.particle_wall.sliding_friction=0.5",
                       "contact.particle_particle.restitution={min=0.1,max=0.5}"}),
              HasSubstr("no experiment that depends on a fitted coefficient has readings"));
  EXPECT_THROW(budget_named("cheap"), base::InputError);
}

TEST_F(StudyRun, KeysNameWhatIsSimulatedAndNotWhatForWhichStudy) {
  const dem::Study study = read();
  const Job job{.experiment = "drop", .values = {.5, .4}, .seed = 3};
  const auto key_in = [](const dem::Study& studied, const Job& asked) {
    return key_of(simulator_of(studied).spec(asked), asked.seed);
  };
  const std::string key = key_in(study, job);
  EXPECT_THAT(key, HasSubstr("drop-"));
  EXPECT_EQ(key_in(read({"experiment.drop.measured = { mean = 9, n = 3 }",
                         "contact.particle_wall.restitution = { min = 0.1, max = 0.95 }"}),
                   job),
            key)
      << "bounds and measurements do not matter";
  for (const char* setting :
       {"experiment.drop.height_mm=90", "particle.density_kg_m3=999", "particle.size_mm=[20,20,19]",
        "wall.poisson_ratio=0.31", "simulation.timestep_fraction=0.9",
        "contact.particle_wall.rolling_friction=0.02"}) {
    EXPECT_NE(key_in(read({setting}), job), key) << setting;
  }
  Job other = job;
  other.seed = 4;
  EXPECT_NE(key_in(study, other), key);
  other = job;
  other.values[0] = .51;
  EXPECT_NE(key_in(study, other), key);
}

TEST_F(StudyRun, GrainsOfAStifferRunAreNeverStifferThanRealOnes) {
  const dem::Study study = read({"experiment.drop.stiffness_factor = 0.25"});
  const Problem problem = problem_of(study, grain_of(study), budget_named("quick")).problem;
  const StudySimulator simulator(study, grain_of(study), problem.parameters, 0);
  Job job{.experiment = "drop", .values = {.5, .4}, .seed = 3};
  EXPECT_EQ(simulator.spec(job).model.stiffness_factor, .25);
  job.inputs.stiffness = 2;
  EXPECT_EQ(simulator.spec(job).model.stiffness_factor, .5);
  job.inputs.stiffness = 10;
  EXPECT_EQ(simulator.spec(job).model.stiffness_factor, 1);
}

TEST_F(StudyRun, AStudyAsksForTheRunsThatASingleExperimentMakes) {
  const dem::Study single = read(
      {"contact.particle_wall.restitution = 0.5", "contact.particle_wall.sliding_friction = 0.4"});
  const RunSpec alone = spec_of(single, dem::experiment_of<dem::DropProtocol>(),
                                NamedGrain(grain_of(single)), kHeapViews);
  const Job job{.experiment = "drop", .values = {.5, .4}, .seed = 3};
  EXPECT_EQ(key_of(alone, job.seed), key_of(simulator_of(read()).spec(job), job.seed));
  const RunStore folder(folder_.path() / "single");
  simulate_experiment(alone, job.seed, {.folder = &folder, .trajectory = {}, .report = {}});
  EXPECT_TRUE(folder.find_whole(simulator_of(read()).spec(job), job.seed));
}

// What the default runs are called is as it was before there was a choice.
TEST_F(StudyRun, SharedDampingMakesOtherRuns) {
  const auto described = [&](const std::string& damping) {
    const dem::Study study = read({"contact.particle_wall.restitution = 0.5",
                                   "contact.particle_wall.sliding_friction = 0.4",
                                   "contact.damping = \"" + damping + "\""});
    const NamedGrain grain(grain_of(study));
    return description_of(
        spec_of(study, dem::experiment_of<dem::DropProtocol>(), grain, kHeapViews), 3);
  };
  EXPECT_THAT(described("per_contact"), Not(HasSubstr("damping")));
  EXPECT_THAT(described("shared"), HasSubstr("\"damping\":\"shared\""));
}

/// Two heights of drop tell how restitution goes with the speed: 100 and 4 mm are fivefold.
TEST_F(StudyRun, TwoHeightsGiveRestitutionAndItsExponentBack) {
  const double e0 = .5, exponent = .12;
  const auto rebound_mm = [&](double height_mm) {
    const double speed = std::sqrt(2 * 9.80665 * height_mm / 1000);
    return height_mm * std::pow(e0 * std::pow(speed / 1.4, -exponent), 2);
  };
  const auto outcome = run(
      "speeds", 2, -1,
      {"particle.young_modulus_pa = 1e8",  // too stiff for its weight to matter
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
  for (const char* tilted : {"20.5", "70"}) {  // the second is out of reach
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
    // What is reported is the fit of all of them, and the check is of coefficients close to it.
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
  std::map<double, int> drops;  // by restitution: those with the seeds of checks
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

/// As a broken machine would: the first drop rebounds as high as it says.
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
    const RunStore runs(folder_.path() / name);  // the ball falls 100 mm
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

TEST_F(StudyRun, ForeseesARunFromItsLaterPace) {
  // 100 steps a second at the beginning, 10 later on.
  const std::vector<WorkLook> looks = {{1, 100}, {2, 110}, {3, 120}, {4, 130}};
  EXPECT_NEAR(foreseen_s(looks, 230).value(), 4 + 10, 1e-9);
  EXPECT_NEAR(foreseen_s(looks, 100).value(), 4, 1e-9) << "no less than it has taken";
  EXPECT_NEAR(foreseen_s({{2, 100}}, 200).value(), 4, 1e-9);
  EXPECT_FALSE(foreseen_s({}, 100));
}

TEST_F(StudyRun, BudgetsSayWhatEveryPhaseTakes) {
  const dem::Study study = read();
  const Budget budget = budget_named("paper");
  const Problem problem = problem_of(study, grain_of(study), budget).problem;
  int fit = 0;
  std::map<Phase, int> runs;
  for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
    fit += estimate.fit_runs();
    for (const auto& [phase, work] : estimate.phases) {
      runs[phase] += work.runs;
      EXPECT_GE(work.seconds, 0);
    }
  }
  EXPECT_LE(fit, 62);
  EXPECT_GT(runs[Phase::first_round], 0);
  EXPECT_GT(runs[Phase::checks], 0);
  EXPECT_EQ(runs[Phase::held_out], 0);
  EXPECT_THAT(foreseen(estimate_of(problem, budget)),
              AllOf(HasSubstr("first round " + std::to_string(runs[Phase::first_round])),
                    HasSubstr("checks " + std::to_string(runs[Phase::checks]))));
}

}  // namespace
}  // namespace repose::calibrate
