#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/propose.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::IsEmpty;

using fake::kTruth;

std::vector<Job> of(const std::string& experiment, const std::vector<Job>& jobs) {
  std::vector<Job> some;
  std::copy_if(jobs.begin(), jobs.end(), std::back_inserter(some),
               [&](const Job& job) { return job.experiment == experiment; });
  return some;
}

double cost(const Problem& problem, const fake::Runs& runs) {
  double sum = 0;
  for (const auto& run : runs) {
    for (const Experiment& experiment : problem.experiments) {
      if (experiment.name == run.job.experiment) sum += experiment.run_s;
    }
  }
  return sum;
}

TEST(Propose, TheFirstRoundFillsTheBoundsAndRepeatsSomePlaces) {
  const Problem problem = fake::problem();
  const std::vector<Job> drops = of("drop", propose(problem, {}));
  ASSERT_GE(drops.size(), 12);
  std::set<std::uint64_t> seeds;
  std::set<std::vector<double>> places;
  for (const Job& job : drops) {
    seeds.insert(job.seed);
    places.insert(job.values);
    EXPECT_EQ(job.values[4], .425);  // the middle: no effect on a drop
  }
  EXPECT_EQ(seeds.size(), drops.size());
  EXPECT_LT(places.size(), drops.size());
  const auto [low, high] =
      std::minmax_element(drops.begin(), drops.end(),
                          [](const Job& a, const Job& b) { return a.values[0] < b.values[0]; });
  EXPECT_LT(low->values[0], .08);
  EXPECT_GT(high->values[0], .53);
}

TEST(Propose, DependsOnWhatIsDoneNotOnItsOrder) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::first_runs(problem);
  const std::vector<Job> second = propose(problem, runs);
  EXPECT_FALSE(second.empty());
  std::reverse(runs.begin(), runs.end());
  std::rotate(runs.begin(), runs.begin() + 17, runs.end());
  EXPECT_EQ(propose(problem, runs), second);
}

TEST(Propose, AsksAgainForWhatIsMissingInTheRound) {
  const Problem problem = fake::problem();
  const std::vector<Job> first = propose(problem, {});
  fake::Runs runs = fake::run_all(first);
  runs.erase(runs.begin() + 3, runs.begin() + 5);
  EXPECT_EQ(propose(problem, runs), (std::vector<Job>{first[3], first[4]}));
}

TEST(Propose, RunsFromElsewhereChangeNothing) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::first_runs(problem);
  const std::vector<Job> second = propose(problem, runs);
  runs.push_back(fake::run({"heap", kTruth, 123456}));
  EXPECT_EQ(propose(problem, runs), second);
}

TEST(Propose, EndsWithinItsBudgetAndNeverRunsAJobTwice) {
  for (const double budget_s : {400., 800.}) {
    Problem problem = fake::problem();
    problem.settings.budget_s = budget_s;
    const fake::Runs runs = fake::study(problem);
    EXPECT_LE(cost(problem, runs), budget_s);
    EXPECT_GT(cost(problem, runs), .5 * budget_s);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(runs[i].job == runs[k].job);
    }
  }
}

TEST(Propose, KeepsToTheMostJobs) {
  Problem problem = fake::problem();
  problem.settings.max_jobs = 60;
  EXPECT_LE(fake::study(problem).size(), 60);
}

/// Number of these jobs with wall coefficients that the cheap experiments leave plausible, which is
/// one in thirty of the whole box.
std::ptrdiff_t on_plausible_walls(const std::vector<Job>& jobs) {
  return std::ranges::count_if(jobs, [](const Job& job) {
    return std::abs(job.values[0] - kTruth[0]) < .15 && std::abs(job.values[1] - kTruth[1]) < .06 &&
           job.values[2] < .1;
  });
}

TEST(Propose, DearHeapsBeginOnWallsThatCheapExperimentsLeavePlausible) {
  const Problem problem = fake::problem();
  const std::vector<Job> lead = propose(problem, {});
  EXPECT_THAT(of("heap", lead), IsEmpty());
  const std::vector<Job> heaps = propose(problem, fake::run_all(lead));
  ASSERT_EQ(of("heap", heaps).size(), heaps.size());
  ASSERT_GE(heaps.size(), 14);
  const auto count = static_cast<std::ptrdiff_t>(heaps.size());
  EXPECT_GE(3 * on_plausible_walls(heaps), 2 * count);
  EXPECT_LT(on_plausible_walls(heaps), count) << "some are anywhere";
  // Nothing is known about contacts between grains, so their whole range is tried.
  for (const std::size_t j : {3U, 4U, 5U}) {
    const auto [low, high] =
        std::ranges::minmax(heaps, {}, [&](const Job& job) { return job.values[j]; });
    const Parameter& parameter = problem.parameters[j];
    EXPECT_GT(high.values[j] - low.values[j], .7 * (parameter.max - parameter.min)) << j;
  }
}

TEST(Propose, ExperimentsThatCostLittleOrStandAloneWaitForNone) {
  Problem cheap = fake::problem();
  cheap.experiments.back().run_s = 2;
  EXPECT_FALSE(of("heap", propose(cheap, {})).empty());
  Problem alone = fake::problem();
  std::erase_if(alone.observables, [](const Observable& o) { return o.experiment != "heap"; });
  const std::vector<Job> heaps = propose(alone, {});
  EXPECT_FALSE(heaps.empty());
  EXPECT_EQ(of("heap", heaps).size(), heaps.size());
}

TEST(Propose, LaterHeapsStandThereToo) {
  const Problem problem = fake::problem();
  const std::vector<Job> second = of("heap", propose(problem, fake::first_runs(problem)));
  ASSERT_GE(second.size(), 3);
  EXPECT_GE(3 * on_plausible_walls(second), 2 * static_cast<std::ptrdiff_t>(second.size()));
}

TEST(Propose, ExperimentsThatAreKnownWellGetNoMoreRuns) {
  const Problem problem = fake::problem();
  EXPECT_THAT(of("tilt", propose(problem, fake::first_runs(problem))), IsEmpty());
}

TEST(Propose, EndsEarlyWhenNothingMovesAnyMore) {
  // One linear reading without random scatter: a second round has nothing to add.
  Problem problem;
  problem.parameters = {{"slope", .1, .8, {}}};
  problem.experiments = {{"tilt", {0}, .5, false, {}}};
  problem.observables = {{"tilt", "tilt", "value", "deg", 22.7, .8, 10, {}}};
  const std::vector<Job> first = propose(problem, {});
  fake::Runs runs;
  for (const Job& job : first) runs.push_back({job, {{"value", 60 * job.values[0]}}, ""});
  EXPECT_THAT(propose(problem, runs), IsEmpty());
}

TEST(Propose, FailedRunsCountAsDone) {
  Problem problem = fake::problem();
  problem.settings.budget_s = 700;
  const fake::Runs runs = fake::study(problem, true);
  EXPECT_TRUE(
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.failure.empty(); }));
  EXPECT_THAT(propose(problem, runs), IsEmpty());
}

TEST(Propose, AllFailedIsAErrorThatSaysWhy) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::first_runs(problem);
  for (auto& run : runs) {
    if (run.job.experiment == "heap") run = {run.job, {}, "the grains stay in the tube"};
  }
  EXPECT_THAT(error_of([&] { propose(problem, runs); }),
              ::testing::HasSubstr("the grains stay in the tube"));
}

TEST(Propose, ReadingsWithWhichAFitWouldNeverEndAreRefused) {
  const Problem problem = fake::problem();
  fake::Runs runs = fake::first_runs(problem);
  runs.front().readings["value"] = 1e200;
  EXPECT_THAT(error_of([&] { propose(problem, runs); }),
              AllOf(::testing::HasSubstr("its reading \"value\" is 1e+200"),
                    ::testing::HasSubstr("Rule: at most 1e+09"), ::testing::HasSubstr("Fix:")));
}

TEST(Propose, EndsWhenItIsInterruptedAndOnlyThen) {
  const Problem problem = fake::problem();
  const fake::Runs runs = fake::first_runs(problem);
  const std::vector<Job> next = propose(problem, runs);
  std::atomic<bool> is_interrupted = false;
  {
    const FitWatch watch(is_interrupted);
    EXPECT_EQ(propose(problem, runs), next);
    is_interrupted = true;
    EXPECT_THROW(propose(problem, runs), FitInterrupted);
  }
  EXPECT_EQ(propose(problem, runs), next);
}

TEST(Propose, AnErroryProblemIsRefused) { EXPECT_THROW(propose({}, {}), base::InputError); }

}  // namespace
}  // namespace repose::calibrate
