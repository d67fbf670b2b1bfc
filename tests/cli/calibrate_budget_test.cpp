// What a calibration says about its time: beforehand, during the run, and with --minutes.
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/calibrate_command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using CalibrateBudget = CalibrateCommandTest;

TEST_F(CalibrateBudget, TellsBeforehandWhatEachBudgetWouldDo) {
  const Finished done = run({"study.toml", "--dry-run", "--jobs", "2"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("quick "), HasSubstr("standard "),
                              HasSubstr("one more hour"), HasSubstr("time at most, 2 cores")));
  EXPECT_FALSE(exists("study_calibration")) << "nothing is written";

  // No fit runs more simulations than announced.
  const auto quick = [&](const std::string& experiment) {
    std::istringstream row(done.out.substr(done.out.find("\n" + experiment + ' ')));
    std::string name, run, unit, plus;
    int fit = 0, checks = 0;
    row >> name >> run >> unit >> fit >> plus >> checks;
    return std::pair{fit, checks};
  };
  const auto [drops, drop_checks] = quick("drop");
  const auto [tilts, tilt_checks] = quick("tilt");
  const json real = result({"study.toml"});
  EXPECT_LE(real["runs"].size(),
            static_cast<std::size_t>(drops + drop_checks + tilts + tilt_checks));
  EXPECT_GT(drops, 0);
  EXPECT_GT(tilts, 0);

  const Finished paper = run({"study.toml", "--dry-run", "--json", "-", "--method", "paper"});
  EXPECT_EQ(paper.exit_code, 2);
  EXPECT_THAT(paper.err, HasSubstr("--method paper"));
}

TEST_F(CalibrateBudget, ADryRunTellsProgramsWhatItTellsPeople) {
  const Finished done = run({"study.toml", "--dry-run", "--jobs", "2", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json times = json::parse(done.out);
  EXPECT_EQ(times["cores"], 2);
  ASSERT_EQ(times["budgets"].size(), 2U);
  EXPECT_EQ(times["budgets"][0]["budget"], "quick");
  EXPECT_GT(times["budgets"][1]["seconds"], times["budgets"][0]["seconds"]);
  EXPECT_EQ(times["budgets"][0]["experiments"][0]["experiment"], "drop");
  EXPECT_GT(times["hour"][1]["runs"], 0);
  EXPECT_GT(times["runs"][1]["seconds"], 0);
  for (const json& budget : times["budgets"]) {
    double seconds = 0;
    int runs = 0, of_experiments = 0;
    for (const json& phase : budget["phases"]) {
      seconds += phase["seconds"].get<double>();
      runs += phase["runs"].get<int>();
    }
    for (const json& one : budget["experiments"]) {
      of_experiments += one["fit_runs"].get<int>() + one["check_runs"].get<int>();
    }
    EXPECT_NEAR(seconds, budget["seconds"], 1e-9);
    EXPECT_EQ(runs, of_experiments);
  }
  const Finished paper = run({"study.toml", "--dry-run", "--budget", "paper", "--json", "-"});
  const json asked = json::parse(paper.out)["budgets"][0];
  EXPECT_EQ(asked["budget"], "paper") << "the budget asked for is among them";
  EXPECT_EQ(files_in("study_calibration/runs"), 0U);
}

TEST_F(CalibrateBudget, TakesTheMinutesItIsGivenAndResumesByTheSamePlan) {
  const Finished done = run({"study.toml", "--minutes", "1"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("with their shares of the work: first round"));
  const json notes = json::parse(text("study_calibration/study.json"));
  EXPECT_EQ(notes["budget"]["limits"]["minutes"], 1);
  const std::string first = text("study_calibration/result.json");
  EXPECT_EQ(json::parse(first)["provenance"]["budget"]["name"], "1min");
  ASSERT_EQ(run({"study.toml", "--minutes", "1"}).exit_code, 0);
  EXPECT_EQ(text("study_calibration/result.json"), first);

  const Finished short_of_time = run({"study.toml", "--minutes", "0.1", "--out", "short"});
  EXPECT_EQ(short_of_time.exit_code, 2);
  EXPECT_THAT(short_of_time.err, AllOf(HasSubstr("(--minutes) = 0.1"), HasSubstr("the least fit"),
                                       HasSubstr("Fix: ")));
  for (const Words& others : {Words{"--budget", "standard"}, Words{"--method", "paper"}}) {
    Words words = {"study.toml", "--minutes", "1"};
    words.insert(words.end(), others.begin(), others.end());
    const Finished both = run(words);
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_THAT(both.err, HasSubstr("--minutes: "));
  }
}

TEST_F(CalibrateBudget, SaysAfterEachRoundWhatIsKnown) {
  const Finished done = run({"study.toml", "--progress", "p.json"});
  ASSERT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.err, HasSubstr("after round 1, provisional (95 %): particle_wall.restitution "));
  const json rounds = json::parse(text("p.json"))["rounds"];
  for (const json& round : rounds) {
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LT(round["intervals"][k][0], round["values"][k]);
      EXPECT_GT(round["intervals"][k][1], round["values"][k]);
    }
  }
}

TEST_F(CalibrateBudget, SaysHowFarItIsInAFile) {
  folder_.write("mine.json", std::string("{}"));
  EXPECT_THAT(run({"study.toml", "--progress", "mine.json"}).err, HasSubstr("--progress"));
  ASSERT_EQ(run({"study.toml", "--progress", "p.json"}).exit_code, 0);
  const json progress = json::parse(text("p.json"));
  EXPECT_FALSE(progress["stage"].get<std::string>().empty());
  EXPECT_GE(progress["done"], 1);
  ASSERT_EQ(progress["parameters"].size(), 2U);
  EXPECT_EQ(progress["parameters"][0]["name"], "contact.particle_wall.restitution");
  // The same as in the result.
  const json result = json::parse(text("study_calibration/result.json"));
  ASSERT_FALSE(progress["rounds"].empty());
  EXPECT_LE(progress["rounds"].size(), result["rounds"].size());
  EXPECT_EQ(progress["rounds"][0]["jobs"], result["rounds"][0]["jobs"]);
  EXPECT_EQ(progress["rounds"][0]["sd"].size(), 2U);
}

}  // namespace
}  // namespace repose::testing
