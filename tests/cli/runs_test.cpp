// repose calibrate --runs, predict and ask: runs of another program.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "base/folder_lock.h"
#include "calibrate/experiment/run_store.h"
#include "tests/calibrate/made_up_table.h"
#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct RunsCommands : CommandTest {
  RunsCommands() : CommandTest({}) {
    folder_.write("study.toml", calibrate::test::made_up_study());
    folder_.write("runs.csv", calibrate::test::made_up_rows());
  }
};

TEST_F(RunsCommands, CalibrateGivesParametersTheirPlainNames) {
  const json found = result({"calibrate", "study.toml", "--runs", "runs.csv", "--out", "out"});
  EXPECT_EQ(found["parameters"][0]["name"], "sliding");
  EXPECT_TRUE(found["verdict"].is_null());
  EXPECT_TRUE(found["observables"][0]["verification"].is_null());
  EXPECT_EQ(found["provenance"]["table"]["rows"], 30);
  EXPECT_FALSE(found["provenance"].contains("clump"));
  EXPECT_EQ(json::parse(text("out/result.json")), found);
  EXPECT_EQ(run({"report", "out"}).exit_code, 0);
  EXPECT_THAT(text("out/report.html"), HasSubstr("Not checked in simulations"));
  const Finished exported = run({"export", "out", "--to", "liggghts"});
  EXPECT_EQ(exported.exit_code, 2);
  EXPECT_THAT(exported.err, HasSubstr("made with another program"));
}

TEST_F(RunsCommands, CalibrateSaysWhatIsNotChecked) {
  const Finished done = run({"calibrate", "study.toml", "--runs", "runs.csv"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("Not checked in simulations"), HasSubstr("undetermined"),
                              Not(HasSubstr("repose export"))));
  EXPECT_LE(longest_line(done.out), 100U);
  EXPECT_TRUE(exists("study_calibration/result.json"));
}

TEST_F(RunsCommands, CalibrateRefusesWhatBelongsToSimulations) {
  const Finished done =
      run({"calibrate", "study.toml", "--runs", "runs.csv", "--budget", "standard", "--dry-run"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("--budget"), HasSubstr("--dry-run"), HasSubstr("Fix: ")));
  const Finished without = run({"calibrate", "study.toml"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("--runs runs.csv"));
}

TEST_F(RunsCommands, TwoAtOnceInOneFolderAreToldApart) {
  std::filesystem::create_directories(path("out/runs"));
  const Words words = {"calibrate", "study.toml", "--runs", "runs.csv", "--out", "out"};
  {
    const base::FolderLock lock(path("out"), calibrate::lock_file_in(path("out")));
    const Finished second = run(words);
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_THAT(second.err, AllOf(HasSubstr("is using it"), HasSubstr("Fix: ")));
    EXPECT_FALSE(exists("out/result.json"));
  }
  EXPECT_EQ(run(words).exit_code, 0);
}

TEST_F(RunsCommands, PredictTellsReadingsAtPoints) {
  folder_.write("points.csv", std::string("sliding,rolling,restitution\n.4,.13,.5\n.2,.2,.3\n"));
  const json found = result({"predict", "study.toml", "--runs", "runs.csv", "--at", "points.csv"});
  ASSERT_EQ(found["points"].size(), 2U);
  const json& angle = found["points"][0]["angle"];
  EXPECT_NEAR(angle["value"].get<double>(), 20, 1);
  EXPECT_LT(angle["interval"][0].get<double>(), 20);
  EXPECT_GT(angle["interval"][1].get<double>(), 20);
  EXPECT_EQ(found["at"][1]["rolling"], .2);
  const Finished shown = run({"predict", "study.toml", "--runs", "runs.csv", "--at", "points.csv"});
  EXPECT_THAT(shown.out, HasSubstr("nothing was simulated"));
  const Finished without = run({"predict", "study.toml", "--at", "points.csv"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("no table is given"));
}

TEST_F(RunsCommands, AskWritesTheNextRuns) {
  const Finished start = run({"ask", "study.toml", "--count", "8", "--out", "next.csv"});
  EXPECT_EQ(start.exit_code, 0) << start.err;
  EXPECT_THAT(text("next.csv"), HasSubstr("sliding,rolling,restitution,angle,reason\n"));
  const Finished more = run({"ask", "study.toml", "--runs", "runs.csv", "--runs", "next.csv",
                             "--count", "4", "--out", "more.csv"});
  EXPECT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.err, HasSubstr("No reading: 8 of 38 rows"));
  const Finished wrong = run({"ask", "study.toml", "--count", "0", "--out", "next.csv"});
  EXPECT_EQ(wrong.exit_code, 2);
  folder_.write("next.csv", std::string("sliding,rolling,restitution,angle,density,reason\n"
                                        ".3,.1,.5,17.5,,may fit\n"));
  const Finished again = run({"ask", "study.toml", "--out", "next.csv"});
  EXPECT_EQ(again.exit_code, 2) << "somebody filled it in";
  EXPECT_THAT(again.err, HasSubstr("holds readings that were filled in"));
  folder_.write("mine.csv", std::string("a,b\n1,2\n"));
  EXPECT_EQ(run({"ask", "study.toml", "--out", "mine.csv"}).exit_code, 2) << "it is somebody's";
}

}  // namespace
}  // namespace repose::testing
