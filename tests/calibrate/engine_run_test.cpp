// Possible outcomes of one run made by a command.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/engine/engine_runs.h"
#include "calibrate/engine/make_runs.h"
#include "calibrate/runs/table_study.h"
#include "tests/calibrate/engine_command_test.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using test::kStudy;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

class OneRunTest : public test::EngineCommandTest {
 protected:
  /// The reason for the failure; empty if the run succeeded.
  std::string failure(const std::string& text) {
    script(text);
    return failure();
  }
  std::string failure_of_reading(const std::string& reading) {
    return failure("cat > \"$folder/reading.json\" <<'END'\n" + reading + "\nEND\n");
  }
  std::string failure() {
    fs::remove_all(place_ / "out");
    fs::create_directories(place_ / "out/runs");
    const TableStudy study = read_table_study(place_ / "study.toml");
    EngineRuns runs(study, place_ / "out");
    runs.plan({}, {{{.5}, "asked for"}});
    std::string told;
    const auto failed = make_runs(runs, *command_engine(study), {0},
                                  {.timeout_s = study.engine->timeout_s,
                                   .note = [&](const std::string& note) { told = note; }});
    EXPECT_EQ(failed.value() == 1, !told.empty());
    EXPECT_EQ(runs.failed(), failed.value());
    EXPECT_THAT(row("run_001"), HasSubstr(told.empty() ? ",ok," : ",failed,"));
    return told;
  }
};

TEST_F(OneRunTest, GivesAReading) {
  EXPECT_THAT(failure_of_reading(R"({"aor": 27.25})"), IsEmpty());
  EXPECT_THAT(row("run_001"), HasSubstr("run_001,0.5,27.25,1,ok,asked for"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 27, "status": "done", "reason": "none"})"), IsEmpty());
  EXPECT_THAT(failure_of_reading(R"({"aor": 1234567})"), HasSubstr("from 0 to 90"));
}

TEST_F(OneRunTest, FailsWithTheReason) {
  EXPECT_THAT(failure("echo almost; exit 3\n"),
              AllOf(HasSubstr("run_001 failed: exit code 3"), HasSubstr("output.txt:\n  almost")));
  EXPECT_THAT(failure("kill -ABRT $$\n"), HasSubstr("ended by signal 6"));
  EXPECT_THAT(failure("exit 0\n"), HasSubstr("left no reading.json. It printed nothing"));
  EXPECT_THAT(failure_of_reading("aor = 27"), HasSubstr("is no JSON"));
  EXPECT_THAT(failure_of_reading(R"({"aor": NaN})"), HasSubstr("has no NaN: write null"));
  EXPECT_THAT(failure_of_reading("[27]"), HasSubstr("is no object"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 1e999})"), HasSubstr("failed"));
  EXPECT_THAT(failure_of_reading(R"({"aor": null})"), HasSubstr("none of its readings"));
  EXPECT_THAT(failure_of_reading(R"({"aor": "failed"})"), HasSubstr("none of its readings"));
  EXPECT_THAT(failure_of_reading(R"({"aor": [27]})"), HasSubstr("aor is [27]"));
  EXPECT_THAT(failure_of_reading(R"({"aor_": 27})"), HasSubstr("has no aor (but aor_)"));
  EXPECT_THAT(failure_of_reading(R"({"aor": "heap.png"})"), HasSubstr("no file in the run's"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 27, "friction": 1})"), HasSubstr("is a parameter"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 27, "status": "lost", "reason": "blew up"})"),
              HasSubstr("lost: blew up"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 27, "status": "perhaps"})"),
              HasSubstr("neither ok nor failed"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 27, "n": 2.5, "aor_sd": 1})"), HasSubstr("n is 2.5"));
}

TEST_F(OneRunTest, SaysHowAReadingIsToBeWritten) {
  EXPECT_THAT(failure_of_reading(R"({"aor": "21,5"})"),
              AllOf(HasSubstr("with a decimal comma"), HasSubstr("write 21.5")));
  EXPECT_THAT(failure_of_reading(R"({"aor": "21.5"})"), HasSubstr("a number as text: write 21.5"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 21,5})"),
              AllOf(HasSubstr("is no JSON"), HasSubstr("write 21.5")));
  EXPECT_THAT(failure_of_reading(R"({"aor": 400})"),
              AllOf(HasSubstr("readings are from 0 to 90"), Not(HasSubstr("NaN"))));
  EXPECT_THAT(failure_of_reading(R"({"aor": 21, "x": {"aor": 3}, "aor": 25})"),
              HasSubstr("has aor twice"));
  EXPECT_THAT(failure_of_reading(R"({"aor": 21, "x": {"aor": 3}})"), IsEmpty());
}

TEST_F(OneRunTest, TakesFilesOfItsFolderOnly) {
  write("heap.png", "not seen");
  for (const std::string name : {"../../../heap.png", "./x/../../heap.png", "/etc/hostname"}) {
    EXPECT_THAT(failure_of_reading(R"({"aor": ")" + name + "\"}"),
                HasSubstr("which is not in the run's folder"))
        << name;
  }
  EXPECT_THAT(failure("cat > \"$folder/reading.json\" <<'END'\n{\"aor\": \"heap.png\"}\nEND\n"
                      ": > \"$folder/heap.png\"\n"),
              HasSubstr("heap.png, which is empty"));
}

TEST_F(OneRunTest, WhoseFolderIsDeletedHasFailed) {
  EXPECT_THAT(failure("rm -r \"$folder\"\n"),
              AllOf(HasSubstr("run_001 failed"), HasSubstr("deleted its run's folder"),
                    Not(HasSubstr("printed nothing"))));
  EXPECT_THAT(text("out/runs/run_001/ended.json"), HasSubstr("deleted its run's folder"));
}

TEST_F(OneRunTest, IsEndedWhenItTakesTooLong) {
  write("study.toml", kStudy + std::string("timeout_s = 1.5\n"));
  EXPECT_THAT(failure("echo hanging; sleep 300 & sleep 300\n"),
              AllOf(HasSubstr("took more than 1.5 s"), HasSubstr("hanging")));
}

TEST_F(OneRunTest, ShowsTheEndOfAMegabyte) {
  EXPECT_THAT(
      failure("awk 'BEGIN { for (i = 0; i < 40000; ++i) print \"step \" i \" of a run\" }'\n"
              "exit 1\n"),
      AllOf(HasSubstr("step 39999 of a run"), Not(HasSubstr("step 39000"))));
}

TEST_F(OneRunTest, LeavesFilesOfOthersAlone) {
  fs::create_directories(place_ / "out/runs/run_001");
  write("out/runs/run_001/thesis.txt", "mine");
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(HasSubstr("no engine's run left")));
  EXPECT_EQ(text("out/runs/run_001/thesis.txt"), "mine");
}

}  // namespace
}  // namespace repose::calibrate
