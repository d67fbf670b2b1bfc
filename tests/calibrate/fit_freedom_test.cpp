#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <gmock/gmock.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/verification.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Experiments without random scatter that read 20 + slope x, and the laboratory reading of each.
struct Lines {
  std::vector<double> slopes;
  std::vector<double> measured;
  double uncertainty = .1;  // of each mean, known from many readings
};

Problem problem_of(const Lines& lines) {
  constexpr int kReadings = 10'000;
  Problem problem;
  problem.parameters = {{"friction", 0, 1, {}}};
  for (std::size_t k = 0; k < lines.slopes.size(); ++k) {
    const std::string name = "line " + std::to_string(k);
    problem.experiments.push_back({name, {0}, 1, false, {"value"}});
    problem.observables.push_back({name,
                                   name,
                                   "value",
                                   "mm",
                                   lines.measured[k],
                                   std::sqrt(double{kReadings}) * lines.uncertainty,
                                   kReadings,
                                   {}});
  }
  return problem;
}

JointFit fit_of_lines(const Problem& problem, const Lines& lines) {
  constexpr int kRuns = 9;
  fake::Runs runs;
  for (std::size_t k = 0; k < lines.slopes.size(); ++k) {
    for (int i = 0; i < kRuns; ++i) {
      const double x = i / (kRuns - 1.);
      runs.push_back(
          {{problem.experiments[k].name, {x}, 1}, {{"value", 20 + lines.slopes[k] * x}}, ""});
    }
  }
  return fit_jointly(problem, runs);
}

JointFit fit_of_lines(const Lines& lines) { return fit_of_lines(problem_of(lines), lines); }

TEST(Freedom, ThreeReadingsOfOneCoefficientLeaveTwo) {
  const Freedom freedom = fit_of_lines(Lines{{10, 20, -10}, {25, 30, 15}}).freedom;
  EXPECT_NEAR(freedom.degrees, 2, .01);
  EXPECT_NEAR(freedom.of_chi2, 2, .01);
  // H = a a^T / (a^T a) for equal uncertainties: a^2 = 100, 400, 100 of 600.
  EXPECT_NEAR(freedom.followed[0][0], 1 / 6., .01);
  EXPECT_NEAR(freedom.followed[1][1], 4 / 6., .01);
  EXPECT_NEAR(freedom.followed[2][1], -2 / 6., .01);
}

TEST(Freedom, WhatAFitUsesUpIsNotTested) {
  EXPECT_LT(fit_of_lines(Lines{{10}, {25}}).freedom.degrees, .01);
  // Two readings, two coefficients.
  Lines lines{{10, 20}, {25, 30}};
  Problem two = problem_of(lines);
  two.parameters.push_back({"bounce", 0, 1, {}});
  two.experiments[1].parameters = {1};
  fake::Runs runs;
  for (int i = 0; i < 9; ++i) {
    const double x = i / 8.;
    runs.push_back({{"line 0", {x, .5}, 1}, {{"value", 20 + 10 * x}}, ""});
    runs.push_back({{"line 1", {.5, x}, 1}, {{"value", 20 + 20 * x}}, ""});
  }
  EXPECT_LT(fit_jointly(two, runs).freedom.degrees, .01);
}

TEST(Freedom, WhatIsKnownBeforehandCountsAsAReading) {
  const Lines lines{{10}, {25}};
  Problem problem = problem_of(lines);
  problem.parameters[0].prior = Prior{.5, .01};  // as certain as the reading: .1 / 10
  const Freedom freedom = fit_of_lines(problem, lines).freedom;
  EXPECT_NEAR(freedom.degrees, .5, .01);
  EXPECT_NEAR(freedom.of_chi2, 1, .01);
}

TEST(Freedom, ACoefficientAtItsBoundFollowsNothing) {
  EXPECT_NEAR(fit_of_lines(Lines{{10}, {35}}).freedom.degrees, 1, .01);
}

TEST(Freedom, ChiSquareIsComparedWithWhatIsLeft) {
  // chi^2 = 2 * 1.65^2 = 5.4: rare with one degree of freedom, not with four.
  const double off = .165;
  const auto no_set_fits = Contains(HasSubstr("no parameter set fits"));
  EXPECT_THAT(fit_of_lines(Lines{{10, 10}, {25 + off, 25 - off}}).warnings, no_set_fits);
  EXPECT_THAT(fit_of_lines(Lines{{10, 10, 10, 10, 10}, {25 + off, 25 - off, 25, 25, 25}}).warnings,
              Not(no_set_fits));
}

/// How often, in percent, simulation and laboratory are said to disagree although they agree:
/// `count` readings that depend linearly on `fitted` coefficients, their fit, and a check by runs
/// with standard uncertainty `u_y`, that of the laboratory being 1, from `n` readings.
double disagreements(int count, int fitted, double u_y, int n, std::uint64_t seed) {
  constexpr int kTrials = 1000;
  constexpr int kRuns = 8;
  Random random(seed);
  int wrong = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::MatrixXd slopes(count, fitted);
    for (double& slope : slopes.reshaped()) slope = random.normal();
    Problem problem;
    problem.parameters = {{"friction", 0, 1, {}}};
    Eigen::VectorXd measured(count), sd(count);
    for (int i = 0; i < count; ++i) {
      double sum = 0, squares = 0;
      for (int k = 0; k < n; ++k) {
        const double reading = std::sqrt(n) * random.normal();
        sum += reading;
        squares += reading * reading;
      }
      measured(i) = sum / n;
      sd(i) = std::sqrt((squares - sum * sum / n) / (n - 1));
      const std::string name = "line " + std::to_string(i);
      problem.experiments.push_back({name, {0}, 1, true, {"value"}});
      problem.observables.push_back(
          {name, name, "value", "mm", 1000 + measured(i), sd(i), n, {}, .001});
    }
    const Eigen::VectorXd weight = (n / sd.array().square()).matrix();
    const Eigen::MatrixXd normal = slopes.transpose() * weight.asDiagonal() * slopes;
    const Eigen::MatrixXd followed =
        slopes * normal.llt().solve(slopes.transpose() * weight.asDiagonal());
    Freedom freedom;
    for (int i = 0; i < count; ++i) {
      const Eigen::RowVectorXd row = followed.row(i);
      freedom.followed.emplace_back(row.begin(), row.end());
      freedom.unsure.emplace_back(count, 0.);
    }
    const Eigen::VectorXd expected = followed * measured;
    fake::Runs runs;
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < kRuns; ++k) {
        const double chance = u_y * std::sqrt(kRuns) * random.normal();
        runs.push_back({{problem.experiments[static_cast<std::size_t>(i)].name,
                         {.5},
                         2'000'000'000 + static_cast<std::uint64_t>(k)},
                        {{"value", 1000 + expected(i) + chance}},
                        ""});
      }
      problem.observables[static_cast<std::size_t>(i)].tolerance = 1e-6;
    }
    const Verification check = verify(problem, {.5}, runs, nullptr, &freedom);
    wrong += check.verdict == AgreementVerdict::disagrees;
  }
  return 100. * wrong / kTrials;
}

TEST(Freedom, WhatIsAlikeIsCalledDifferentInOneOfTwentyCases) {
  // 5 +- .7 % (one sigma) in 1000 trials.
  constexpr int kMany = 200;
  EXPECT_NEAR(disagreements(2, 1, .2, kMany, 1), 5, 2.5);
  EXPECT_NEAR(disagreements(3, 2, .2, kMany, 2), 5, 2.5);
  EXPECT_NEAR(disagreements(4, 3, .2, kMany, 3), 5, 2.5);
  EXPECT_NEAR(disagreements(5, 3, .5, kMany, 4), 5, 2.5);
  EXPECT_NEAR(disagreements(4, 3, 1, kMany, 5), 5, 2.5);
  EXPECT_NEAR(disagreements(4, 1, 3, kMany, 6), 5, 2.5) << "hardly anything is the bench's";
  EXPECT_NEAR(disagreements(4, 2, .3, 5, 7), 5, 2.5) << "few readings";
}

}  // namespace
}  // namespace repose::calibrate
