#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/stiffer_coefficients.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kSliding =
    4;  // of grain and grain: the heap tells it, once the rest is known

/// A bench whose heaps are of grains ten times stiffer than the study's: they are 2.5 degrees
/// flatter. All coefficients but one are known beforehand.
Problem of_stiff_bench() {
  Problem problem = fake::problem();
  problem.settings.budget_s = 1e6;
  for (std::size_t k = 0; k < fake::kTruth.size(); ++k) {
    if (k != kSliding) problem.parameters[k].prior = Prior{fake::kTruth[k], .005};
  }
  std::ranges::find(problem.experiments, "heap", &Experiment::name)->real_stiffness = 10;
  std::ranges::find(problem.observables, "heap", &Observable::name)->mean -= fake::kSofteningShift;
  return problem;
}

StiffnessCheck check_of_heap(double change, const Interval& interval) {
  StiffnessCheck check;
  check.name = "heap";
  check.change = change;
  check.interval = interval;
  return check;
}

double width(const Interval& interval) { return interval.high - interval.low; }

bool holds_truth(const Interval& interval) {
  return interval.low <= fake::kTruth[kSliding] && fake::kTruth[kSliding] <= interval.high;
}

struct StifferCoefficients : ::testing::Test {
  Problem problem_ = of_stiff_bench();
  fake::Runs runs_ = fake::first_runs(problem_);
};

TEST_F(StifferCoefficients, AreThoseOfTheBenchWhereSoftGrainsAskForOthers) {
  constexpr int kRepeats = 40;
  const JointFit soft = fit_jointly(problem_, runs_);
  std::vector<double> values;
  for (const FittedParameter& parameter : soft.parameters) values.push_back(parameter.value);
  fake::Runs all = runs_;
  for (auto& run : fake::run_all(verification_jobs(problem_, values, kRepeats, 0))) {
    all.push_back(std::move(run));
  }
  for (auto& run : fake::run_all(plan_stiffness(problem_, values, kRepeats).jobs)) {
    all.push_back(std::move(run));
  }
  const auto stiffer =
      stiffer_coefficients(problem_, check_stiffness(problem_, values, all, soft), runs_);
  ASSERT_THAT(stiffer, SizeIs(fake::kTruth.size()));
  EXPECT_EQ(stiffer[kSliding].name, soft.parameters[kSliding].name);
  EXPECT_FALSE(holds_truth(soft.parameters[kSliding].interval));
  EXPECT_TRUE(holds_truth(stiffer[kSliding].interval));
  EXPECT_EQ(stiffer[kSliding].verdict, Verdict::determined);
}

TEST_F(StifferCoefficients, AreAsUncertainAsTheChangesThatTheyTakeIntoAccount) {
  const auto sure = stiffer_coefficients(problem_, {check_of_heap(-2.5, {-2.6, -2.4})}, runs_);
  const auto unsure = stiffer_coefficients(problem_, {check_of_heap(-2.5, {-6.5, 1.5})}, runs_);
  EXPECT_GT(width(unsure[kSliding].interval), 2 * width(sure[kSliding].interval));
  EXPECT_TRUE(holds_truth(unsure[kSliding].interval));
}

TEST_F(StifferCoefficients, AreNotThereWhereItIsNotKnownWhatStiffeningChanges) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(stiffer_coefficients(problem_, {}, runs_), IsEmpty());
  EXPECT_THAT(stiffer_coefficients(problem_, {check_of_heap(none, {none, none})}, runs_),
              IsEmpty());
  StiffnessCheck of_held_out = check_of_heap(0, {-1, 1});
  of_held_out.name = "fill";
  EXPECT_THAT(stiffer_coefficients(problem_, {of_held_out}, runs_), IsEmpty());
}

}  // namespace
}  // namespace repose::calibrate
