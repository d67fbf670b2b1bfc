// repose calibrate --runs, predict and ask: runs of another program, and a command that makes runs.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child_process.h"
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

/// A command whose fourth run hangs until there is a file "go", and writes its process ID to "pid".
struct EngineCommands : CommandTest {
  EngineCommands() : CommandTest({"calibrate", "study.toml"}) {
    folder_.write("study.toml",
                  std::string("[parameter]\nfriction = { min = 0.1, max = 0.7 }\n"
                              "[measured]\naor = { mean = 22, sd = 1, n = 4, unit = \"deg\" }\n"
                              "[engine]\ncommand = \"sh run.sh\"\n"));
    folder_.write("run.sh", std::string(R"(
number() { sed -n "s/^ *\"$1\": \([-0-9.e]*\),*$/\1/p" "$folder/run.json"; }
folder=$1
seed=$(number seed)
if [ $seed = 4 ] && [ ! -e go ]; then echo $$ > pid; sleep 300; fi
angle=$(awk -v f=$(number friction) -v s=$seed 'BEGIN { print 8 + 40 * f + .5 * sin(37 * s) }')
echo "{\"aor\": $angle}" > "$folder/reading.json"
)"));
  }

  /// Starts it and waits until the fourth run hangs.
  pid_t start_until_it_hangs() const {
    std::filesystem::remove(path("pid"));
    const pid_t program = start_repose(folder_, {"calibrate", "study.toml"});
    while (!exists("pid") || text("pid").empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return program;
  }
  static int end_of(pid_t program, int signal) {
    ::kill(program, signal);
    int status = 0;
    ::waitpid(program, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path output_ = path("study_calibration/runs/run_004/output.txt");
};
using EngineKilled = EngineCommands;

TEST_F(EngineCommands, MakeRunsAndTellHowMany) {
  folder_.write("go", std::string());
  const Finished dry = run({"--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_THAT(dry.out, AllOf(HasSubstr("Runs made: 0"), HasSubstr("To be made next: 6")));
  EXPECT_FALSE(exists("study_calibration"));
  const json found = result({"--jobs", "2", "--max-runs", "10"});
  EXPECT_EQ(found["parameters"][0]["name"], "friction");
  EXPECT_EQ(found["provenance"]["table"]["engine"]["command"], "sh run.sh");
  EXPECT_LE(found["provenance"]["table"]["engine"]["runs"], 10);
  EXPECT_EQ(run_repose(folder_, {"report", "study_calibration"}).exit_code, 0);
  EXPECT_THAT(text("study_calibration/report.html"), HasSubstr("command: sh run.sh"));
  EXPECT_THAT(run({"--dry-run"}).out, Not(HasSubstr("nothing tells yet")));
  const Finished predicted = run_repose(
      folder_,
      {"ask", "study.toml", "--runs", "study_calibration/runs/runs.csv", "--out", "next.csv"});
  EXPECT_EQ(predicted.exit_code, 0) << predicted.err;
}

TEST_F(EngineCommands, RefuseOptionsThatDoNothing) {
  const Finished done = run({"--budget", "standard", "--jobs", "0", "--max-runs", "many"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("--budget: is of simulations, and with [engine] none"),
                              HasSubstr("--jobs 0"), HasSubstr("--max-runs many")));
  folder_.write("table.toml", calibrate::test::made_up_study());
  folder_.write("runs.csv", calibrate::test::made_up_rows());
  const Finished table =
      run_repose(folder_, {"calibrate", "table.toml", "--runs", "runs.csv", "--max-runs", "9"});
  EXPECT_EQ(table.exit_code, 2);
  EXPECT_THAT(table.err, HasSubstr("--max-runs: is of runs that are to be made"));
  folder_.write("own.toml", std::string("[particle]\nsize_mm = 5\n[engine]\ncommand = \"x\"\n"));
  const Finished own = run_repose(folder_, {"calibrate", "own.toml", "--max-runs", "9"});
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_THAT(own.err, AllOf(HasSubstr("is for studies with [parameter] and [engine]"),
                             HasSubstr("this one repose simulates itself")));
}

TEST_F(EngineKilled, CtrlCEndsTheProgramsAndTheSameCommandGoesOn) {
  const pid_t program = start_until_it_hangs();
  EXPECT_TRUE(base::is_in_use(output_));
  EXPECT_EQ(end_of(program, SIGINT), 130);
  EXPECT_FALSE(base::is_in_use(output_)) << "the program of the run is still there";
  EXPECT_FALSE(exists("study_calibration/result.json"));
  EXPECT_THAT(text("study_calibration/runs/runs.csv"), HasSubstr(",3,ok,"));
  EXPECT_EQ(run_repose(folder_, {"report", "study_calibration"}).exit_code, 0);
  EXPECT_THAT(
      text("study_calibration/report.html"),
      AllOf(HasSubstr("3 runs were made by another program, of which 0 failed, and 3"),
            HasSubstr("study.toml --out study_calibration"), HasSubstr("Aor against friction")));
  folder_.write("go", std::string());
  EXPECT_EQ(run({}).exit_code, 0);
  std::filesystem::rename(path("study_calibration"), path("parts"));
  EXPECT_EQ(run({}).exit_code, 0);
  EXPECT_EQ(text("parts/result.json"), text("study_calibration/result.json"));
}

TEST_F(EngineKilled, ProgramsThatAKilledOneLeftAreNotMixedUp) {
  const pid_t program = start_until_it_hangs();
  const pid_t group = ::getpgid(std::stoi(text("pid")));
  end_of(program, SIGKILL);
  ASSERT_TRUE(base::is_in_use(output_));
  folder_.write("go", std::string());
  const Finished beside = run({});
  EXPECT_EQ(beside.exit_code, 2);
  EXPECT_THAT(beside.err, AllOf(HasSubstr("run_004"), HasSubstr("still running there")));
  ::kill(-group, SIGKILL);
  while (base::is_in_use(output_)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Finished last = run({});
  EXPECT_EQ(last.exit_code, 0) << last.err;
}

}  // namespace
}  // namespace repose::testing
