// Which experiments of a study have coarse runs, what these simulate, and what is said about them.

#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/fit/points.h"
#include "calibrate/study/study_estimate.h"
#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_record.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/experiment_table.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;

/// Balls in a tube that holds about 1,900 of them.
constexpr const char* kHeapOfMany = R"([experiment.heap]
tube_diameter_mm = 30
tube_height_mm = 60
stiffness_factor = 0.1
measured = { mean = 20, sd = 1, n = 5 }
)";

class CoarseStudy : public ::testing::Test {
 protected:
  StudyRecord record(double size_mm = 3, const std::string& heap = kHeapOfMany,
                     const std::string& setting = "study.title = \"balls\"") const {
    StudyRecord record;
    record.study =
        dem::read_study(folder_.write("study.toml", test::kSphereStudy + heap),
                        {fmt::format("particle.size_mm = [{0}, {0}, {0}]", size_mm), setting,
                         // Rough enough to form a heap.
                         "contact.particle_wall.rolling_friction = 0.2",
                         "contact.particle_particle.sliding_friction = 0.8",
                         "contact.particle_particle.rolling_friction = 0.3"});
    record.grain = dem::build_grain(record.study.grain);
    record.method = "joint";
    record.budget = budget_named("quick");
    return record;
  }

  static Problem problem_in(const StudyRecord& record) {
    return problem_of(record.study, record.grain, record.budget).problem;
  }

  static Job heap_job(const Problem& problem, const AssumedInputs& inputs) {
    const Experiment& heap = experiment_named(problem, "heap");
    Job job = job_at(problem, heap, Point(problem.parameters.size(), .5), 3);
    job.inputs = inputs;
    return job;
  }

  TemporaryFolder folder_;
};

TEST_F(CoarseStudy, HeapsOfManyGrainsHaveCoarseRunsAndOthersNone) {
  const Problem many = problem_in(record());
  ASSERT_TRUE(experiment_named(many, "heap").coarse);
  EXPECT_THAT(experiment_named(many, "heap").coarse->size, AllOf(Ge(1.5), Le(2.5)));
  EXPECT_FALSE(experiment_named(many, "drop").coarse);
  EXPECT_FALSE(experiment_named(problem_in(record(8)), "heap").coarse);
  StudyRecord full = record();
  full.budget.is_full = true;
  EXPECT_FALSE(experiment_named(problem_in(full), "heap").coarse);
}

TEST_F(CoarseStudy, GrainsAskedForByNumberAreFewerLikewise) {
  const StudyRecord counted = record(3, std::string(kHeapOfMany) + "grains = 1500\n");
  const Problem problem = problem_in(counted);
  const AssumedInputs coarse = experiment_named(problem, "heap").usual_inputs();
  const StudySimulator simulator(counted.study, counted.grain, problem.parameters, 0);
  const RunSpec spec = simulator.spec(heap_job(problem, coarse));
  EXPECT_NEAR(*spec.protocol.as<dem::HeapProtocol>().grains, 1500 / std::pow(coarse.size, 3), 1);
  EXPECT_EQ(*simulator.spec(heap_job(problem, {})).protocol.as<dem::HeapProtocol>().grains, 1500);
}

TEST_F(CoarseStudy, TheSameClumpIsLargerAndAllElseStays) {
  const StudyRecord study = record();
  const Problem problem = problem_in(study);
  const StudySimulator simulator(study.study, study.grain, problem.parameters, 0);
  const AssumedInputs coarse = experiment_named(problem, "heap").usual_inputs();
  const RunSpec full = simulator.spec(heap_job(problem, {}));
  const RunSpec larger = simulator.spec(heap_job(problem, coarse));
  EXPECT_NEAR(larger.model.grain.volume_m3, std::pow(coarse.size, 3) * full.model.grain.volume_m3,
              1e-12);
  EXPECT_EQ(larger.model.grain.spheres.size(), full.model.grain.spheres.size());
  EXPECT_EQ(larger.model.stiffness_factor, full.model.stiffness_factor);
  EXPECT_EQ(larger.model.grain_wall.sliding_friction, full.model.grain_wall.sliding_friction);
  EXPECT_NE(key_of(larger, 3), key_of(full, 3));
  EXPECT_THAT(description_of(larger, 3), HasSubstr("grain_size"));
  EXPECT_THAT(description_of(full, 3), Not(HasSubstr("grain_size")));
}

TEST_F(CoarseStudy, LargerGrainsMayHaveMoreSpheres) {
  const StudyRecord study = record(3, std::string(kHeapOfMany), "particle.size_mm = [4, 3, 3]");
  const Problem problem = problem_in(study);
  const StudySimulator simulator(study.study, study.grain, problem.parameters, 0);
  AssumedInputs inputs = experiment_named(problem, "heap").usual_inputs();
  const RunSpec coarse = simulator.spec(heap_job(problem, inputs));
  EXPECT_GT(coarse.grain_size, 1);
  inputs.spheres = 3;
  const RunSpec finer = simulator.spec(heap_job(problem, inputs));
  EXPECT_EQ(finer.model.grain.spheres.size(), 3 * coarse.model.grain.spheres.size());
  EXPECT_NEAR(finer.model.grain.volume_m3, coarse.model.grain.volume_m3,
              .01 * coarse.model.grain.volume_m3);
  EXPECT_EQ(finer.grain_size, coarse.grain_size);
}

TEST_F(CoarseStudy, ACoarseRunHasAsFewGrainsAsForeseen) {
  const StudyRecord study = record();
  const Problem problem = problem_in(study);
  const StudySimulator simulator(study.study, study.grain, problem.parameters, 0);
  const Job job = heap_job(problem, experiment_named(problem, "heap").usual_inputs());
  const std::atomic<bool> is_interrupted{false};
  const auto run = run_of(job, simulator.simulate(job, is_interrupted));
  ASSERT_EQ(run.failure, "");
  EXPECT_THAT(run.readings.at("grains"), AllOf(Ge(200), Le(400)));
}

TEST_F(CoarseStudy, TheFolderTellsMixedRunsFromFullOnes) {
  const std::filesystem::path kept = folder_.path() / "kept";
  std::filesystem::create_directory(kept);
  StudyRecord full = record();
  full.budget.is_full = true;
  EXPECT_FALSE(is_same_study(identity_of(record()), identity_of(full)));
  write_study_record(kept, record());
  EXPECT_FALSE(read_study_record(kept).budget.is_full);
  write_study_record(kept, full);
  EXPECT_TRUE(read_study_record(kept).budget.is_full);
  // Without any coarse runs, the setting makes no difference.
  StudyRecord few = record(8);
  const StudyIdentity mixed = identity_of(few);
  few.budget.is_full = true;
  EXPECT_TRUE(is_same_study(mixed, identity_of(few)));
}

// dem/PERFORMANCE.md: of 5,000 and 50,000 each takes 1.2 and 2.9 times as long.
TEST_F(CoarseStudy, ARunOfManyGrainsTakesLongerThanTheirNumber) {
  const Problem few = problem_in(record(3)), many = problem_in(record(1.3));
  const Experiment &heap_of_few = experiment_named(few, "heap"),
                   &heap_of_many = experiment_named(many, "heap");
  const double by_number = std::pow(3 / 1.3, 4);  // 2,000 and 24,000, and shorter steps
  const double longer = heap_of_many.run_s / heap_of_few.run_s / by_number;
  EXPECT_THAT(longer, AllOf(Ge(1.7), Le(2.5)));
  EXPECT_NEAR(usual_run_s(heap_of_many) * std::pow(heap_of_many.coarse->size, 4),
              heap_of_many.run_s / dem::many_grains_factor(24'000), .2 * heap_of_many.run_s);
  EXPECT_EQ(dem::many_grains_factor(100), 1);
  EXPECT_EQ(dem::many_grains_factor(5000), 1.2);
  EXPECT_EQ(dem::many_grains_factor(1e6), 2.9);
  EXPECT_NEAR(dem::many_grains_factor(8660), 1.6, .01) << "between, by the logarithm";
}

TEST_F(CoarseStudy, FullRunsHaveTheSmallestGrainsWhoseRunsTheBudgetAllows) {
  StudyRecord study = record();
  const Experiment own = experiment_named(problem_in(study), "heap");
  EXPECT_EQ(own.full.size, 1);
  study.budget.longest_run_s = .5 * own.run_s;
  const StudyProblem made = problem_of(study.study, study.grain, study.budget);
  const Experiment& heap = experiment_named(made.problem, "heap");
  EXPECT_LE(heap.run_s, study.budget.longest_run_s);
  EXPECT_GT(heap.run_s, .9 * study.budget.longest_run_s) << "no larger than needed";
  EXPECT_NEAR(heap.full.size, std::pow(2, .25), .02);
  EXPECT_EQ(heap.coarse, own.coarse);
  EXPECT_NEAR(usual_run_s(heap), usual_run_s(own), .05 * usual_run_s(own));
  EXPECT_EQ(job_at(made.problem, heap, Point(made.problem.parameters.size(), .5), 3).inputs,
            heap.full);
  const double added = .2 * (heap.full.size - 1);
  EXPECT_NEAR(heap.model_fraction, std::hypot(own.model_fraction, added), 1e-12);
  EXPECT_NEAR(made.problem.observables.back().model_sd, 20 * heap.model_fraction, 1e-9);
  EXPECT_NEAR(made.problem.observables.back().size_sd, 20 * added, 1e-9);
  EXPECT_THAT(made.notes, Contains(AllOf(HasSubstr("2 times as long as this budget allows"),
                                         HasSubstr("model error"), HasSubstr("--fidelity full"))));
  EXPECT_EQ(experiment_named(made.problem, "drop").full.size, 1);
  study.budget.is_full = true;
  EXPECT_EQ(experiment_named(problem_in(study), "heap").full.size, 1);
}

TEST_F(CoarseStudy, WithHardlyAnyTimeAllRunsAreCoarse) {
  StudyRecord study = record();
  const Experiment own = experiment_named(problem_in(study), "heap");
  study.budget.longest_run_s = usual_run_s(own);
  const Experiment heap = experiment_named(problem_in(study), "heap");
  EXPECT_FALSE(heap.coarse);
  EXPECT_EQ(heap.full, *own.coarse);
  EXPECT_NEAR(heap.run_s, usual_run_s(own), .05 * heap.run_s);
}

TEST_F(CoarseStudy, WhatItsMinutesAllowIsKeptInTheFolder) {
  const std::filesystem::path kept = folder_.path() / "kept";
  std::filesystem::create_directory(kept);
  StudyRecord study = record();
  study.budget = budget_of(10, 2);
  EXPECT_EQ(study.budget.longest_run_s, 100) << "a twelfth of twenty minutes";
  EXPECT_EQ(budget_of(10, 16).longest_run_s, 100) << "a sixth of the minutes";
  EXPECT_EQ(budget_of(10, 2, 2).longest_run_s, 50) << "on slower cores";
  write_study_record(kept, study);
  EXPECT_EQ(read_study_record(kept).budget.longest_run_s, 100);
  study.budget = budget_named("standard");
  write_study_record(kept, study);
  EXPECT_EQ(read_study_record(kept).budget.longest_run_s, study.budget.longest_run_s);
}

TEST_F(CoarseStudy, GrainsThatAreCountedAreTheStudysOwn) {
  StudyRecord study = record(3, std::string(kHeapOfMany) +
                                    "[experiment.heap.also_measured]\n"
                                    "grains_off_plate = { mean = 9, sd = 1, n = 5 }\n");
  study.budget.longest_run_s = 1;
  const Experiment heap = experiment_named(problem_in(study), "heap");
  EXPECT_EQ(heap.full.size, 1);
  EXPECT_FALSE(heap.coarse);
}

TEST_F(CoarseStudy, ItsRoundsAreForeseenAsCoarseRuns) {
  const StudyRecord mixed = record();
  StudyRecord full = mixed;
  full.budget.is_full = true;
  const Problem problem = problem_in(mixed);
  const Experiment& heap = experiment_named(problem, "heap");
  const auto heap_in = [](const std::vector<ExperimentEstimate>& estimates) {
    return *std::ranges::find(estimates, "heap", &ExperimentEstimate::experiment);
  };
  const PhaseWork first = heap_in(estimate_of(problem, mixed.budget)).of(Phase::first_round);
  EXPECT_NEAR(first.seconds, first.runs * usual_run_s(heap), 1e-9);
  const PhaseWork all_full =
      heap_in(estimate_of(problem_in(full), full.budget)).of(Phase::first_round);
  EXPECT_LT(first.seconds / first.runs, .5 * all_full.seconds / all_full.runs);
}

TEST_F(CoarseStudy, DearChecksAreFewerAndOthersAsAsked) {
  const StudyRecord study = record();
  const Problem problem = problem_in(study);
  Problem dear = problem;
  for (Experiment& experiment : dear.experiments) {
    if (experiment.coarse) experiment.run_s = dear.settings.budget_s / 10;
  }
  const Budget fewer = with_affordable_checks(study.budget, dear);
  EXPECT_EQ(fewer.verification_repeats, 5);
  EXPECT_EQ(fewer.round_repeats, 2);
  EXPECT_EQ(fewer.check_rounds, 2);
  EXPECT_EQ(fewer.family_sets, 0);
  // If full runs are only a little too expensive, only their number of repeats is reduced.
  for (Experiment& experiment : dear.experiments) {
    if (experiment.coarse) experiment.run_s = dear.settings.budget_s / 40;
  }
  const Budget nearly = with_affordable_checks(study.budget, dear);
  EXPECT_EQ(nearly.verification_repeats, 20);
  EXPECT_EQ(nearly.check_rounds, study.budget.check_rounds);
  EXPECT_EQ(nearly.family_sets, study.budget.family_sets);
  for (Experiment& experiment : dear.experiments) experiment.coarse.reset();
  EXPECT_EQ(with_affordable_checks(study.budget, dear).verification_repeats,
            study.budget.verification_repeats);
}

}  // namespace
}  // namespace repose::calibrate
