#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>

#include "calibrate/fit/first_round.h"
#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/training_set.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using testing::HasSubstr;

const std::vector<double> kTruth = {.31, .42, .05, .2, .3, .06};

/// Prior, failures and all.
Problem full_problem(bool robust) {
  Problem problem = fake::problem(kTruth, 1);
  problem.parameters[3].prior = Prior{.2, .05};
  problem.settings.robust = robust;
  return problem;
}

Misfit misfit_of(const Problem& problem, bool jams) {
  return {problem, in_order(problem, fake::run_all(first_round(problem), jams)), {}, false};
}

TEST(Misfit, DerivativesAreThoseOfItsValues) {
  for (const bool robust : {false, true}) {
    const Misfit misfit = misfit_of(full_problem(robust), true);
    const Point here = {.5, .3, .4, .6, .8, .7};  // near where heaps jam
    const Residuals all = misfit.residuals(here, true);
    for (std::size_t j = 0; j < here.size(); ++j) {
      constexpr double kStep = 1e-5;
      Point up = here;
      Point down = here;
      up[j] += kStep;
      down[j] -= kStep;
      const std::vector<double> above = misfit.residuals(up, false).values;
      const std::vector<double> below = misfit.residuals(down, false).values;
      for (std::size_t i = 0; i < all.values.size(); ++i) {
        const double slope = (above[i] - below[i]) / (2 * kStep);
        EXPECT_NEAR(all.jacobian[i][j], slope, 2e-3 * std::max(1., std::abs(slope)))
            << "residual " << i << ", coordinate " << j << ", robust " << robust;
      }
    }
  }
}

TEST(Misfit, FewReadingsCountAsStudentSays) {
  Observable observable{"a", "drop", "value", "mm", 10, 1, 10, {}};
  EXPECT_NEAR(few_readings_factor(observable), 2.262157 / 1.959964, 1e-6);
  observable.n = 2;
  EXPECT_NEAR(few_readings_factor(observable), 12.7062 / 1.959964, 1e-4);
  observable.sd.reset();
  EXPECT_EQ(few_readings_factor(observable), 1);
}

TEST(Misfit, FailuresNearbyMakeASetUnlikely) {
  Problem problem = full_problem(false);
  problem.settings.budget_s = 12000;
  const Misfit jammed = misfit_of(problem, true);
  const Misfit free = misfit_of(problem, false);
  const Point corner = {.5, .5, .5, .5, .95, .9};
  const std::size_t place = problem.observables.size();
  EXPECT_GT(jammed.residuals(corner, false).values[place], 1);
  EXPECT_LT(free.residuals(corner, false).values.size(),
            jammed.residuals(corner, false).values.size());
}

TEST(Misfit, AReadingThatNoRunHasIsNamedWithThoseThereAre) {
  Problem problem = full_problem(false);
  problem.observables[3].reading = "hight_mm";
  EXPECT_THAT(error_of([&] { misfit_of(problem, false); }),
              testing::AllOf(HasSubstr("heap: 0 of "), HasSubstr("\"base_radius_mm\"")));
}

TEST(Misfit, RunsOfAnotherProblemAreRefused) {
  const Problem problem = full_problem(false);
  EXPECT_THROW(in_order(problem, {{{"slump", kTruth, 1}, {}, ""}}), std::invalid_argument);
  EXPECT_THROW(in_order(problem, {{{"heap", {.1}, 1}, {}, ""}}), std::invalid_argument);
  EXPECT_THROW(in_order(problem, {{{"heap", {NAN, 0, 0, 0, 0, 0}, 1}, {}, ""}}),
               std::invalid_argument);
}

TEST(Minimum, StaysInTheBoxAndHoldsWhatIsHeld) {
  const Misfit misfit = misfit_of(full_problem(false), false);
  const Minimum free = least_minimum(misfit, {});
  EXPECT_LT(free.chi2, .1);
  const Minimum held = minimum_from(misfit, Point(6, .99), 1);
  EXPECT_EQ(held.point[1], .99);
  EXPECT_GT(held.chi2, 100);
  for (const double x : held.point) {
    EXPECT_GE(x, 0);
    EXPECT_LE(x, 1);
  }
}

TEST(Plausible, SpreadIsThatOfTheKnowledge) {
  // Only the prior tells anything of the restitution between grains: its own spread comes back.
  const Problem problem = full_problem(false);
  const PlausibleSets sets = plausible_sets(misfit_of(problem, false), 7);
  const double width = problem.parameters[3].max - problem.parameters[3].min;
  EXPECT_NEAR(problem.parameters[3].min + mean_of(sets.points)[3] * width, .2, .012);
  EXPECT_NEAR(sd_of(sets.points)[3] * width, .05, .008);
  EXPECT_NEAR(sd_of(sets.wide)[3] * width, .1, .02);
}

}  // namespace
}  // namespace repose::calibrate
