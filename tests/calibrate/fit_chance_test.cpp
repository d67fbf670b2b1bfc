#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/fit/verification.h"

namespace repose::calibrate {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

/// Inside a gtest test, Run names something else.
using Runs = std::vector<Run>;
using OneRun = Run;

constexpr double kFall_mm = 500;
constexpr double kTwentieth = .01;  // mm, by which another seed changes a rebound

/// A ball dropped 500 mm onto a plate. Treated as stochastic, as it is with other grain shapes.
Problem ball_drop() {
  Problem problem;
  problem.parameters = {{"restitution", .6, .99, {}}};
  problem.experiments = {{"drop", {0}, 1, true, {"value", "lowest_point_rise_mm"}}};
  problem.observables = {{"drop", "drop", "value", "mm", 405, 8, 20, {}}};
  problem.settings.budget_s = 40;
  return problem;
}

/// h = e^2 H; `scatter_mm` is the amplitude of the seed's effect.
Run dropped(const Job& job, double scatter_mm = 0) {
  const double rise = kFall_mm * job.values[0] * job.values[0] +
                      scatter_mm * std::sin(static_cast<double>(job.seed));
  return {job, {{"value", rise}, {"lowest_point_rise_mm", rise - .3}}, {}};
}

Runs drops_of(const Problem& problem, double scatter_mm = 0) {
  Runs runs;
  for (const Job& job : propose(problem, {})) runs.push_back(dropped(job, scatter_mm));
  for (const Job& job : verification_jobs(problem, {.9}, 6, 0)) {
    runs.push_back(dropped(job, scatter_mm));
  }
  return in_order(problem, runs);
}

TEST(Chance, HasNoPartInRunsThatOtherSeedsRepeat) {
  const Problem problem = ball_drop();
  EXPECT_FALSE(has_chance(problem.experiments[0], drops_of(problem)));
  EXPECT_TRUE(has_chance(problem.experiments[0], drops_of(problem, kTwentieth)));
  Experiment tilt = problem.experiments[0];
  tilt.is_stochastic = false;
  EXPECT_FALSE(has_chance(tilt, {}));
}

TEST(Chance, OneRepeatThatDiffersInAnyReadingIsEnough) {
  const Problem problem = ball_drop();
  Runs runs = drops_of(problem);
  const auto repeat = [&]() -> OneRun& {
    return *std::find_if(runs.begin(), runs.end(),
                         [](const OneRun& run) { return run.job.seed > 1'000'000'003; });
  };
  repeat().readings["lowest_point_rise_mm"] += 1e-6;
  EXPECT_TRUE(has_chance(problem.experiments[0], runs));
  runs = drops_of(problem);
  repeat().readings.clear();
  repeat().failure = "it never rose";
  EXPECT_TRUE(has_chance(problem.experiments[0], runs));
}

TEST(Chance, IsThereUntilRepeatsOfDifferentReadingsShowThatItIsNot) {
  const Problem problem = ball_drop();
  Runs once = drops_of(problem);
  const auto same_place = [](const OneRun& a, const OneRun& b) {
    return a.job.values == b.job.values;
  };
  once.erase(std::unique(once.begin(), once.end(), same_place), once.end());
  EXPECT_TRUE(has_chance(problem.experiments[0], once));
  Runs all_the_same = drops_of(problem);
  for (OneRun& run : all_the_same) run.readings = {{"value", 0}, {"lowest_point_rise_mm", 0}};
  EXPECT_TRUE(has_chance(problem.experiments[0], all_the_same)) << "as of grains that never leave";
}

TEST(Chance, WithoutItRepeatsTellNoMoreThanTheFirst) {
  const Problem problem = ball_drop();
  const Runs runs = drops_of(problem);
  const TrainingSet sure = training_set_of(problem, problem.experiments[0], "value", runs);
  std::vector<Point> places = sure.places;
  std::sort(places.begin(), places.end());
  EXPECT_EQ(std::unique(places.begin(), places.end()), places.end());
  EXPECT_EQ(readings_among(problem.experiments[0], "value", runs), static_cast<int>(runs.size()));
  const Runs others = drops_of(problem, kTwentieth);
  EXPECT_THAT(training_set_of(problem, problem.experiments[0], "value", others).places,
              SizeIs(others.size()));
}

/// Restitution of a ball: e = sqrt(h / H), with Student's interval of the measured mean alone.
TEST(Chance, ABallsRestitutionIsAsUncertainAsItsReboundsAndNoMore) {
  const Problem problem = ball_drop();
  const JointFit fit = fit_jointly(problem, drops_of(problem));
  const double half_mm = 2.093024 * 8 / std::sqrt(20);
  EXPECT_NEAR(fit.parameters[0].value, std::sqrt(405 / kFall_mm), 2e-4);
  EXPECT_NEAR(fit.parameters[0].interval.low, std::sqrt((405 - half_mm) / kFall_mm), 2e-4);
  EXPECT_NEAR(fit.parameters[0].interval.high, std::sqrt((405 + half_mm) / kFall_mm), 2e-4);
  EXPECT_EQ(fit.observables[0].simulated_sd, 0);
  EXPECT_EQ(fit.observables[0].predicted_sd, 0);
  EXPECT_THAT(fit.warnings, SizeIs(0));
  EXPECT_THAT(fit.curves[0].scatter, Each(0));
}

/// Two readings of one experiment that the simulation cannot vary independently: the correlation of
/// the laboratory scatter is unknown and taken as 0.
TEST(Chance, WithoutItReadingsOfOneExperimentAreTakenForIndependent) {
  Problem problem = ball_drop();
  problem.observables.push_back(
      {"drop.lowest_point_rise_mm", "drop", "lowest_point_rise_mm", "mm", 409, 8, 20, {}});
  const JointFit fit = fit_jointly(problem, drops_of(problem));
  EXPECT_EQ(fit.reading_correlation[0][1], 0);
  // The best compromise is 2.15 mm off both means, each known within 1.91 mm (with Student-t).
  const double u = 8 / std::sqrt(20) * 2.093024 / 1.959964;
  EXPECT_NEAR(fit.chi2, 2 * std::pow(2.15 / u, 2), .05);
}

}  // namespace
}  // namespace repose::calibrate
