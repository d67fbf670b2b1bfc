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

/// A bench whose heaps are of grains ten times stiffer than the study's.
Problem of_stiff_bench() {
  Problem problem = fake::problem();
  problem.settings.budget_s = 1e6;
  std::ranges::find(problem.experiments, "heap", &Experiment::name)->real_stiffness = 10;
  std::ranges::find(problem.observables, "heap", &Observable::name)->mean -= fake::kSofteningShift;
  return problem;
}

struct Fitted {
  fake::Runs runs;
  std::vector<FittedParameter> parameters;
  std::vector<StifferCoefficient> stiffer;
};

/// As a study does: fit, check, stiffer grains at the fitted coefficients.
Fitted fitted_with(const Problem& problem, int repeats) {
  Fitted fitted{.runs = fake::study(problem), .parameters = {}, .stiffer = {}};
  fitted.parameters = fit_jointly(problem, fitted.runs).parameters;
  std::vector<double> values;
  for (const FittedParameter& parameter : fitted.parameters) values.push_back(parameter.value);
  for (Run& run : fake::run_all(verification_jobs(problem, values, repeats, 0))) {
    fitted.runs.push_back(std::move(run));
  }
  const JointFit fit = fit_jointly(problem, fitted.runs, {values});
  fake::Runs all = fitted.runs;
  for (Run& run : fake::run_all(plan_stiffness(problem, values, repeats).jobs)) {
    all.push_back(std::move(run));
  }
  fitted.stiffer =
      stiffer_coefficients(problem, check_stiffness(problem, values, all, fit), fitted.runs);
  return fitted;
}

double width(const Interval& interval) { return interval.high - interval.low; }

bool holds_truth(const Interval& interval, std::size_t k) {
  return interval.low <= fake::kTruth[k] && fake::kTruth[k] <= interval.high;
}

TEST(StifferCoefficients, AreThoseOfTheBenchWhereSoftGrainsAskForOthers) {
  const Fitted fitted = fitted_with(of_stiff_bench(), 40);
  ASSERT_THAT(fitted.stiffer, SizeIs(fake::kTruth.size()));
  for (std::size_t k = 0; k < fake::kTruth.size(); ++k) {
    EXPECT_EQ(fitted.stiffer[k].name, fitted.parameters[k].name);
    EXPECT_TRUE(holds_truth(fitted.stiffer[k].interval, k)) << fitted.stiffer[k].name;
  }
  const bool all_held = std::ranges::all_of(std::vector<std::size_t>{3, 4, 5}, [&](std::size_t k) {
    return holds_truth(fitted.parameters[k].interval, k);
  });
  EXPECT_FALSE(all_held) << "heaps of soft grains are 2.5 degrees steeper";
}

TEST(StifferCoefficients, AreAsUncertainAsTheChangesThatTheyTakeIntoAccount) {
  Problem problem = of_stiff_bench();
  const fake::Runs runs = fake::study(problem);
  StiffnessCheck check{.name = "heap", .change = -2.5, .interval = {-2.6, -2.4}};
  const auto sure = stiffer_coefficients(problem, {check}, runs);
  check.interval = {-8, 3};
  const auto unsure = stiffer_coefficients(problem, {check}, runs);
  double wider = 0;
  for (std::size_t k = 3; k < 6; ++k) {
    wider += width(unsure[k].interval) - width(sure[k].interval);
  }
  EXPECT_GT(wider, .05);
}

TEST(StifferCoefficients, AreNotThereWhereItIsNotKnownWhatStiffeningChanges) {
  const Problem problem = of_stiff_bench();
  const fake::Runs runs = fake::study(problem);
  EXPECT_THAT(stiffer_coefficients(problem, {}, runs), IsEmpty());
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      stiffer_coefficients(
          problem, {{.name = "heap", .change = none, .interval = {none, none}, .failed_runs = 5}},
          runs),
      IsEmpty());
  EXPECT_THAT(stiffer_coefficients(problem, {{.name = "fill", .interval = {-1, 1}}}, runs),
              IsEmpty())
      << "held out: nothing was fitted to it";
}

}  // namespace
}  // namespace repose::calibrate
