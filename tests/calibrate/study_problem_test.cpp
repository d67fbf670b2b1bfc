#include "calibrate/study/study_problem.h"

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/study/study_estimate.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/roll.h"
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

using ProblemOfStudy = test::SphereStudyTest;

TEST_F(ProblemOfStudy, TakesItsProblemFromTheStudy) {
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

TEST_F(ProblemOfStudy, CoefficientsOfAPartAreSoughtWhereTheBenchHasIt) {
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

// Stored runs keep their names.
TEST_F(ProblemOfStudy, ARunIsNamedAfterThePartsOfItsBenchAlone) {
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

TEST_F(ProblemOfStudy, SaysWhenTheDefinitionOfAHeapsAngleIsAssumed) {
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

TEST_F(ProblemOfStudy, ALayerIsAFailedRunOfTheFit) {
  const dem::Study study = read({"experiment.heap={grains=12,lift_speed_mm_s=200}",
                                 "contact.particle_wall.rolling_friction=0.3"});
  const std::atomic<bool> is_interrupted = false;
  const Job job{.experiment = "heap", .values = {.5, .2}, .seed = 1};
  const auto found = run_of(job, simulator_of(study).simulate(job, is_interrupted));
  EXPECT_THAT(found.readings, IsEmpty());
  EXPECT_THAT(found.failure, AllOf(HasSubstr("spread to a layer"), HasSubstr("Fix: ")));
}

TEST_F(ProblemOfStudy, AnUnknownScatterIsAssumed) {
  const dem::Study study = read({"experiment.drop.measured = { mean = 25, n = 5 }"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.observables[0].assumed_sd_fraction,
            dem::experiment_of<dem::DropProtocol>()->usual_scatter);
}

TEST_F(ProblemOfStudy, ADropIsTheMeanOfItsGrains) {
  const dem::Study study = read({"experiment.drop.grains = 7"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.experiments[0].readings_per_run, 7);
  EXPECT_EQ(made.problem.experiments[1].readings_per_run, 1);
}

TEST_F(ProblemOfStudy, SomethingMustBeLeftToFit) {
  const dem::Study study =
      read({"experiment.tilt.held_out = true", "experiment.drop.held_out = true"});
  EXPECT_THAT(error_of([&] { problem_of(study, grain_of(study), budget_named("quick")); }),
              HasSubstr("has readings, but for those held out"));
}

TEST_F(ProblemOfStudy, TheToleranceIsTheStudys) {
  const dem::Study study = read({"experiment.drop.measured = { mean = 25, n = 5, tolerance = 3 }"});
  const StudyProblem made = problem_of(study, grain_of(study), budget_named("quick"));
  EXPECT_EQ(made.problem.observables[0].tolerance, 3);
  EXPECT_FALSE(made.problem.observables[1].tolerance);
}

TEST_F(ProblemOfStudy, StudiesInWhichNothingCanBeFoundAreRefused) {
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

TEST_F(ProblemOfStudy, KeysNameWhatIsSimulatedAndNotWhatForWhichStudy) {
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

TEST_F(ProblemOfStudy, GrainsOfAStifferRunAreNeverStifferThanRealOnes) {
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

TEST_F(ProblemOfStudy, AStudyAsksForTheRunsThatASingleExperimentMakes) {
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

// The names of default runs are the same as before there was a choice.
TEST_F(ProblemOfStudy, SharedDampingMakesOtherRuns) {
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

TEST_F(ProblemOfStudy, ForeseesARunFromItsLaterPace) {
  // 100 steps a second at first, 10 later.
  const std::vector<WorkLook> looks = {{1, 100}, {2, 110}, {3, 120}, {4, 130}};
  EXPECT_NEAR(foreseen_s(looks, 230).value(), 4 + 10, 1e-9);
  EXPECT_NEAR(foreseen_s(looks, 100).value(), 4, 1e-9) << "no less than it has taken";
  EXPECT_NEAR(foreseen_s({{2, 100}}, 200).value(), 4, 1e-9);
  EXPECT_FALSE(foreseen_s({}, 100));
}

TEST_F(ProblemOfStudy, BudgetsSayWhatEveryPhaseTakes) {
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
