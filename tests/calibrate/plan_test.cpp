#include "calibrate/plan/plan.h"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/points.h"
#include "calibrate/plan/offers.h"
#include "calibrate/start/usual_experiment.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Lt;

// Two parameters from 0 to 1. Experiments read 100 plus the effect of these.
constexpr double kBase = 100, kSlope = 40, kScatter = .05;

double expected_reading(const std::string& experiment, const std::vector<double>& values) {
  const double a = values[0], b = values[1];
  if (experiment == "first" || experiment == "jams") return kBase + kSlope * a;
  if (experiment == "second") return kBase + kSlope * b;
  if (experiment == "sum") return kBase + kSlope / 2 * (a + b);
  return kBase;  // uninformative
}

Problem problem_with(const std::vector<std::string>& experiments) {
  Problem problem;
  problem.parameters = {{.name = "a", .min = 0, .max = 1, .prior = {}},
                        {.name = "b", .min = 0, .max = 1, .prior = {}}};
  for (const std::string& name : experiments) {
    problem.experiments.push_back({.name = name, .parameters = {0, 1}});
  }
  return problem;
}

std::vector<Run> runs_of(const Problem& problem) {
  constexpr int kRuns = 30;
  Random random(1);
  std::vector<Run> runs;
  for (const Experiment& experiment : problem.experiments) {
    for (int k = 0; k < kRuns; ++k) {
      Run run{.job = job_at(problem, experiment, sequence_point(static_cast<std::size_t>(k), 2),
                            static_cast<std::uint64_t>(k)),
              .readings = {},
              .failure = {}};
      if (experiment.name == "jams" && run.job.values[0] > .3) {
        run.failure = "it jams";
      } else {
        run.readings["value"] =
            expected_reading(experiment.name, run.job.values) + kScatter * random.normal();
      }
      runs.push_back(run);
    }
  }
  return runs;
}

Foresight foresight_of(const Problem& problem, int readings = 10) {
  return {problem, runs_of(problem), readings};
}

/// Ten readings, of the material at the centre of the box.
Observable measured(const std::string& experiment) {
  Observable observable;
  observable.name = observable.experiment = experiment;
  observable.mean = kBase + kSlope / 2;
  observable.sd = 5;
  observable.n = 10;
  return observable;
}

std::vector<std::string> planned(const Foresight& foresight) {
  std::vector<std::string> names;
  for (const PlannedStep& step : smallest_set(foresight)) {
    names.push_back(foresight.prospects()[step.experiment].experiment);
  }
  return names;
}

TEST(Foresight, AnIntervalIsThatOfAStraightLineThroughReadingsThatScatterByFivePercent) {
  const DesignForecast outlook = foresight_of(problem_with({"first"})).with({0});
  // Uniform from 0 to 1: a variance of 1/12. Single readings of 120 scatter by 6.
  const double u = .05 * (kBase + kSlope / 2) / std::sqrt(10.) / kSlope;
  const double sd = 1 / std::sqrt(12 + 1 / (u * u));
  EXPECT_NEAR(outlook.widths[0], 2 * 1.96 * sd, .01);
  EXPECT_GT(outlook.widths[1], .75) << "nothing was read of it";
  // Within both bounds, and at most a quarter of the value to either side.
  const double half = 1.96 * sd;
  EXPECT_NEAR(outlook.determined[0], 1 - half - 4 * half, .1);
  EXPECT_LT(outlook.determined[1], .1);
}

TEST(Foresight, WhatTheStudyCallsUsefulIsEnoughToDetermine) {
  Problem problem = problem_with({"first"});
  problem.parameters[0].useful_half_width = .2;
  EXPECT_GT(foresight_of(problem).with({0}).determined[0], .75);
}

TEST(Foresight, FourTimesAsManyReadingsHalveAnInterval) {
  const Problem problem = problem_with({"first"});
  const double ten = foresight_of(problem, 10).with({0}).widths[0];
  EXPECT_NEAR(foresight_of(problem, 40).with({0}).widths[0] / ten, .5, .05);
}

TEST(Foresight, AnEffectIsTheChangeFromBoundToBoundOverItsUncertainty) {
  const Foresight foresight = foresight_of(problem_with({"first", "dull"}));
  const double u = .05 * (kBase + kSlope / 2) / std::sqrt(10.);
  EXPECT_NEAR(foresight.prospects()[0].effects[0], kSlope / u, 1.5);
  EXPECT_LT(foresight.prospects()[0].effects[1], .3);
  EXPECT_THAT(foresight.prospects()[1].effects, Each(Lt(.3)));
}

TEST(Foresight, WhatReadingsHaveInCommonIsNotLoweredByMoreOfThem) {
  Problem problem = problem_with({"first"});
  problem.experiments[0].systematic_fraction = .05;
  // As large as the scatter of a single reading: averaging ten hardly helps.
  const double u = .05 * (kBase + kSlope / 2) * std::sqrt(1 + 1 / 10.) / kSlope;
  EXPECT_NEAR(foresight_of(problem).with({0}).widths[0], 2 * 1.96 / std::sqrt(12 + 1 / (u * u)),
              .05);
  EXPECT_GT(foresight_of(problem, 1000).with({0}).widths[0],
            .9 * foresight_of(problem).with({0}).widths[0]);
}

TEST(Foresight, WhatGivesNoReadingOfMostMaterialsTellsLittle) {
  const Foresight foresight = foresight_of(problem_with({"first", "jams"}));
  EXPECT_GT(foresight.prospects()[1].failed_runs, 15);
  EXPECT_LT(foresight.with({1}).determined[0], .5);
  EXPECT_GT(foresight.with({0}).determined[0], foresight.with({1}).determined[0] + .1);
}

TEST(SmallestSet, HasOneExperimentForEachParameterAndNoneThatTellsNothing) {
  EXPECT_THAT(planned(foresight_of(problem_with({"dull", "sum", "first", "second"}))),
              ::testing::UnorderedElementsAre("first", "second"));
}

TEST(SmallestSet, LeavesOutWhatIsMeasured) {
  Problem problem = problem_with({"first", "second"});
  problem.observables.push_back(measured("first"));
  const Foresight foresight = foresight_of(problem);
  EXPECT_LT(foresight.with({}).widths[0], .25);
  EXPECT_THAT(planned(foresight), ElementsAre("second"));
  problem.observables.push_back(measured("second"));
  EXPECT_THAT(planned(foresight_of(problem)), IsEmpty());
}

class OfferedStudyTest : public ::testing::Test {
 protected:
  dem::Study study_of(const std::string& text) const {
    folder_.write("study.toml", text);
    return dem::read_study(folder_.path() / "study.toml");
  }
  static OfferedStudy offered(const dem::Study& study) {
    return offered_study(study, dem::build_grain(study.grain), plan_budget(1e6),
                         every_experiment());
  }
  TemporaryFolder folder_;
};

TEST_F(OfferedStudyTest, HasEveryExperimentThatDependsOnWhatIsSoughtAndWhatWasMeasured) {
  const OfferedStudy made = offered(study_of(test::kSphereStudy));
  EXPECT_EQ(made.study.experiments.size(), dem::all_experiments().size());
  std::vector<std::string> names, measured;
  for (const Experiment& one : made.problem.experiments) names.push_back(one.name);
  for (const Observable& one : made.problem.observables) measured.push_back(one.name);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"drop", "tilt", "roll", "heap", "fill"}));
  EXPECT_THAT(names, Each(::testing::Not("pendulum"))) << "grains alone touch in it";
  EXPECT_THAT(measured, ElementsAre("drop", "tilt"));
  EXPECT_EQ(made.problem.observables[0].n, 5);
}

TEST_F(OfferedStudyTest, HasNothingButItsOwnExperimentsAndThoseThatCouldBeDone) {
  const dem::Study study = study_of(test::kSphereStudy);
  const OfferedStudy made = offered_study(
      study, dem::build_grain(study.grain), plan_budget(60),
      {dem::experiment_of<dem::TiltProtocol>(), dem::experiment_of<dem::RollProtocol>()});
  EXPECT_EQ(made.study.experiments.size(), 3U);
  ASSERT_EQ(made.added.size(), 1U);
  EXPECT_EQ(made.added.begin()->first, dem::experiment_of<dem::RollProtocol>());
}

TEST_F(OfferedStudyTest, LeavesOutWhatWouldTakeLongerThanAllOfItMayAndSaysSo) {
  const dem::Study study = study_of(test::kSphereStudy);
  const dem::ClumpFile grain = dem::build_grain(study.grain);
  const OfferedStudy made = offered_study(study, grain, plan_budget(6), every_experiment());
  EXPECT_FALSE(made.added.contains(dem::experiment_of<dem::DrawDownProtocol>()));
  EXPECT_FALSE(made.study.experiments.contains(dem::experiment_of<dem::DrawDownProtocol>()));
  EXPECT_THAT(made.notes, ::testing::Contains(HasSubstr("draw_down is left out: its simulations")));
  EXPECT_THAT(made.notes.front(), HasSubstr("give --minutes"));
  EXPECT_EQ(made.problem.observables.size(), 2U) << "what is measured stays";
  const OfferedStudy all = offered_study(study, grain, plan_budget(1e6), every_experiment());
  EXPECT_THAT(all.notes, ElementsAre(HasSubstr("fill: how fast it was poured is not said")));
}

TEST_F(OfferedStudyTest, LinesForTheStudyFileAreReadAsTheExperimentThatWasPlanned) {
  const OfferedStudy made = offered(study_of(test::kSphereStudy));
  std::string text = test::kSphereStudy;
  for (const auto& [experiment, described] : made.added) {
    const std::string section = study_section(*experiment, described);
    EXPECT_THAT(section, HasSubstr("measured = { readings = \""));
    text += section.substr(0, section.find("measured = "));  // before the sheet is filled in
  }
  const dem::Study read = study_of(text);
  for (const auto& [experiment, described] : made.added) {
    const dem::ExperimentEntry& entry = *experiment;
    dem::Protocol again = read.experiments.at(experiment).protocol;
    EXPECT_EQ(protocol_lines(entry, again), protocol_lines(entry, described.protocol));
    EXPECT_EQ(read.experiments.at(experiment).stiffness_factor, described.stiffness_factor);
  }
}

TEST_F(OfferedStudyTest, OfLargeGrainsHasTubesThatHoldABulkOfThem) {
  std::string text = test::kSphereStudy;
  text.replace(text.find("20, 20, 20"), 10, "60, 40, 40");
  text.replace(text.find("spheres = 1"), 11, "spheres = 3");
  const OfferedStudy made = offered(study_of(text));
  EXPECT_GE(made.study.protocol<dem::FillProtocol>().tube_diameter_m, 4 * .06);
  EXPECT_GE(made.study.protocol<dem::HeapProtocol>().tube_diameter_m, 5 * .04);
}

TEST_F(OfferedStudyTest, WhatAPlanSimulatedIsOfferedToACalibrationInTheSameFolder) {
  const dem::Study study = study_of(test::kSphereStudy);
  const dem::ClumpFile grain = dem::build_grain(study.grain);
  const RunStore folder(folder_.path() / "runs");
  for (const Offer& offer : offers_in(folder, study, grain)) {
    EXPECT_THAT(offer.runs, IsEmpty()) << offer.experiment.name;
    EXPECT_THAT(offer.study_lines, HasSubstr("[experiment." + offer.experiment.name + "]"));
  }

  const OfferedStudy small = offered_study(
      study, grain, plan_budget(200),
      {dem::experiment_of<dem::RollProtocol>(), dem::experiment_of<dem::FillProtocol>()});
  const StudySimulator simulator(small.study, grain, small.problem.parameters);
  std::vector<calibrate::Run> saved;
  for (const Job& job : plan_jobs(small)) {
    RunResult run;
    run.seed = job.seed;
    run.simulated = description_of(simulator.spec(job), job.seed);
    run.value = 7;
    run.timestep_s = 1e-6;
    run.readings["time_s"] = 1;
    folder.save(simulator.spec(job), run);
    if (job.experiment == "roll") saved.push_back(run_of(job, run));
  }
  std::map<std::string, Offer> offers;
  for (const Offer& offer : offers_in(folder, study, grain)) offers[offer.experiment.name] = offer;
  EXPECT_FALSE(offers.contains("tilt")) << "what the study has is not offered";
  EXPECT_FALSE(offers["fill"].runs.empty());
  EXPECT_THAT(offers["pendulum"].runs, IsEmpty());
  const Offer& roll = offers["roll"];
  ASSERT_EQ(roll.runs.size(), saved.size());
  for (std::size_t k = 0; k < saved.size(); ++k) {
    EXPECT_EQ(roll.runs[k].job, saved[k].job);
    EXPECT_EQ(roll.runs[k].readings.at("value"), 7);
  }
}

TEST_F(OfferedStudyTest, WithNothingToFindIsRefused) {
  std::string text = test::kSoftBall;
  for (const char* pair : {"particle_wall", "particle_particle"}) {
    text += std::string("[contact.") + pair +
            "]\nrestitution = 0.2\nsliding_friction = 0.2\nrolling_friction = 0.04\n";
  }
  EXPECT_THAT(error_of([&] { offered(study_of(text + "[experiment.drop]\nheight_mm = 100\n")); }),
              HasSubstr("every coefficient has a value, so there is nothing to fit"));
}

}  // namespace
}  // namespace repose::calibrate
