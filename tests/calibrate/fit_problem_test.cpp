#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "calibrate/fit/problem.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/error_of.h"
#include "tests/support/texts_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Problem sound() { return fake::problem(); }

TEST(Problem, ASoundOneHasNoErrors) { EXPECT_THAT(texts_of(errors_of(sound())), IsEmpty()); }

TEST(Problem, AnEmptyOneSaysWhatIsMissing) {
  EXPECT_THAT(texts_of(errors_of({})),
              ElementsAre(HasSubstr("no parameter"), HasSubstr("nothing was")));
}

TEST(Problem, EveryErrorIsToldAtOnceWithItsFix) {
  Problem problem = sound();
  problem.parameters[0].min = .7;
  problem.parameters[1].max = kNaN;
  problem.parameters[2].prior = Prior{.05, 0};
  problem.parameters[3].prior = Prior{2, .1};
  problem.observables[0].mean = kNaN;
  problem.observables[1].sd = 0;
  problem.observables[2].n = 1;
  problem.observables[3].sd.reset();
  problem.experiments[3].run_s = -1;
  problem.settings.max_rounds = 0;
  const std::vector<std::string> errors = texts_of(errors_of(problem));
  EXPECT_EQ(errors.size(), 10);
  EXPECT_THAT(errors, ::testing::Each(HasSubstr("Fix: ")));
  EXPECT_THAT(errors, Contains(AllOf(HasSubstr("particle_wall.restitution"), HasSubstr("min = 0.7"),
                                     HasSubstr("max = 0.6"))));
  EXPECT_THAT(errors, Contains(AllOf(HasSubstr("tilt"), HasSubstr("resolution"))));
  EXPECT_THAT(errors, Contains(AllOf(HasSubstr("roll"), HasSubstr("one reading has no sd"))));
  EXPECT_THAT(errors, Contains(AllOf(HasSubstr("heap"), HasSubstr("assumed_sd_share"))));
  const std::string refusal = error_of([&] { require_sound(problem); });
  for (const std::string& error : errors) EXPECT_THAT(refusal, HasSubstr(error));
}

TEST(Problem, AParameterThatNothingMeasuredDependsOnIsNoError) {
  Problem problem = sound();
  problem.observables.pop_back();  // the heap
  EXPECT_THAT(texts_of(errors_of(problem)), IsEmpty());
}

TEST(Problem, NamesMustFitTogether) {
  Problem problem = sound();
  problem.observables[1].name = problem.observables[0].name;
  problem.observables[2].experiment = "rol";
  problem.experiments[0].parameters.push_back(0);
  problem.experiments[1].parameters.push_back(17);
  EXPECT_THAT(texts_of(errors_of(problem)),
              AllOf(Contains(HasSubstr("two observables are called \"drop\"")),
                    Contains(HasSubstr("no experiment is called \"rol\"")),
                    Contains(HasSubstr("twice")), Contains(HasSubstr("parameter 17, of 6"))));
}

TEST(Problem, AShareOfAMeanOfNothingIsNoScatter) {
  Problem problem = sound();
  problem.observables[0].mean = 0;
  problem.observables[0].sd.reset();
  problem.observables[0].assumed_sd_fraction = .1;
  EXPECT_THAT(texts_of(errors_of(problem)),
              ElementsAre(HasSubstr("drop: a fraction of a mean of 0")));
}

TEST(Problem, ABudgetThatBuysNoFitIsRefusedWithTheLeast) {
  Problem problem = sound();
  problem.settings.budget_s = 100;
  problem.settings.max_jobs = 10;
  // 14 heaps of 25 s, 8 each of .6, .5 and 1 s.
  EXPECT_THAT(texts_of(errors_of(problem)),
              ElementsAre(HasSubstr("367 s"), HasSubstr("at least 38")));
  problem.settings.budget_s = kNaN;
  EXPECT_THAT(texts_of(errors_of(problem)), Contains(HasSubstr("budget_s = nan")));
}

TEST(Problem, UncertaintyIsOfTheMean) {
  Observable observable{"a", "drop", "value", "mm", 10, 3, 9, {}};
  EXPECT_DOUBLE_EQ(standard_uncertainty(observable), 1);
  observable.sd.reset();
  observable.assumed_sd_fraction = .06;
  observable.mean = -10;
  EXPECT_DOUBLE_EQ(standard_uncertainty(observable), .2);
}

}  // namespace
}  // namespace repose::calibrate
