#include "calibrate/run/minutes_budget.h"

#include <atomic>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/study/study_record.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class MinutesBudget : public ::testing::Test {
 protected:
  MinutesBudget()
      : study_(dem::read_study(folder_.write("study.toml", test::kSphereStudy), {})),
        grain_(dem::build_grain(study_.grain)),
        problem_(problem_of(study_, grain_, budget_named("quick")).problem) {
    // As if a drop took a minute and a tilt a second.
    for (const Experiment& experiment : problem_.experiments) {
      pace_[experiment.name] = (experiment.name == "drop" ? 60 : 1) / experiment.run_s;
    }
  }

  /// Total time of all phases on one core.
  double foreseen_minutes(const Budget& budget) const {
    const Problem problem = problem_of(study_, grain_, budget).problem;
    double seconds = 0;
    for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
      seconds += pace_.at(estimate.experiment) * estimate.all().seconds;
    }
    return seconds / 60;
  }

  std::string refusal_of_two_minutes() const {
    return error_of([&] { budget_within(2, problem_, pace_, 1); });
  }

  /// The minimum that a refusal names.
  static double least_minutes(const std::string& refusal) {
    const std::string option = "--minutes ";
    return std::stod(refusal.substr(refusal.find(option) + option.size()));
  }

  repose::testing::TemporaryFolder folder_;
  dem::Study study_;
  dem::ClumpFile grain_;
  Problem problem_;
  Pace pace_;
};

TEST_F(MinutesBudget, SpendsWhatItIsGivenAndNoMore) {
  for (const double minutes : {30., 60., 100.}) {
    const Budget one = budget_within(minutes, problem_, pace_, 1);
    EXPECT_LE(foreseen_minutes(one), minutes) << minutes;
    EXPECT_GE(foreseen_minutes(one), .7 * minutes) << minutes;
    const Budget two = budget_within(minutes, problem_, pace_, 2);
    EXPECT_LE(foreseen_minutes(two), 2 * minutes) << minutes;
    EXPECT_GT(foreseen_minutes(two), foreseen_minutes(one)) << minutes;
  }
}

TEST_F(MinutesBudget, AShortTimeHasFewerChecks) {
  const Budget brief = budget_within(least_minutes(refusal_of_two_minutes()), problem_, pace_, 1);
  const Budget ample = budget_within(200, problem_, pace_, 1);
  EXPECT_EQ(brief.check_rounds, 2);
  EXPECT_EQ(brief.verification_repeats, 4);
  EXPECT_EQ(ample.check_rounds, 3);
  EXPECT_GT(ample.verification_repeats, brief.verification_repeats);
}

TEST_F(MinutesBudget, ChecksGetNoMoreThanHalf) {
  const Budget budget = budget_within(60, problem_, pace_, 1);
  double checks_s = 0;
  const Problem problem = problem_of(study_, grain_, budget).problem;
  for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
    for (const Phase phase : {Phase::checks, Phase::equal_sets}) {
      checks_s += pace_.at(estimate.experiment) * estimate.of(phase).seconds;
    }
  }
  EXPECT_LE(checks_s / 60, .5 * foreseen_minutes(budget));
}

TEST_F(MinutesBudget, RefusesLessThanTheLeastFitAndSaysWhatItNeeds) {
  const std::string error = refusal_of_two_minutes();
  EXPECT_THAT(error, AllOf(HasSubstr("the least fit, its checks included, takes"),
                           HasSubstr("a run of drop takes 60 s"), HasSubstr("--jobs")));
  const double needed = least_minutes(error);
  EXPECT_GT(needed, 2);
  EXPECT_LE(foreseen_minutes(budget_within(needed, problem_, pace_, 1)), needed);
  EXPECT_THROW(budget_within(.8 * needed, problem_, pace_, 1), base::InputError);
}

TEST_F(MinutesBudget, IsKeptInTheFolderAndNotTimedAgain) {
  PreparedStudy study;
  study.folder = folder_.path() / "kept";
  std::filesystem::create_directory(study.folder);
  study.record.study = study_;
  study.record.grain = grain_;
  study.record.method = "joint";
  study.record.budget = budget_within(60, problem_, pace_, 1);
  write_study_record(study.folder, study.record);
  const Budget read = read_study_record(study.folder).budget;
  EXPECT_EQ(read.name, "60min");
  EXPECT_EQ(read.settings.budget_s, study.record.budget.settings.budget_s);
  EXPECT_EQ(read.verification_repeats, study.record.budget.verification_repeats);
  EXPECT_EQ(read.check_rounds, study.record.budget.check_rounds);
  study.record.budget = budget_named("quick");
  study.problem.problem = problem_;
  study.threads = 1;
  const std::atomic<bool> never = false;
  const Budget again = budget_of_minutes(60, study, never);
  EXPECT_EQ(again.settings.budget_s, read.settings.budget_s)
      << "by the real pace it would be another";
  EXPECT_NE(budget_of_minutes(61, study, never).settings.budget_s, read.settings.budget_s);
}

TEST(BudgetOfMinutes, IsKnownByItsName) {
  EXPECT_EQ(minutes_in(name_of_minutes(12.5)), 12.5);
  EXPECT_FALSE(minutes_in("quick"));
  EXPECT_FALSE(minutes_in("min"));
}

}  // namespace
}  // namespace repose::calibrate
