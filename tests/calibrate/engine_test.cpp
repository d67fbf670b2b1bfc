// Studies whose runs are made by a command.
#include "calibrate/engine/engine.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/engine/engine_study.h"
#include "calibrate/result/result.h"
#include "tests/calibrate/engine_command_test.h"
#include "tests/support/error_of.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using test::kAngle;
using test::kRead;
using test::kStudy;
using test::kWrite;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

using EngineStudyTest = test::EngineCommandTest;

TEST_F(EngineStudyTest, MakesRunsUntilNothingWouldNarrow) {
  const StudyResult result = calibrated(request());
  const auto& found = std::get<JointResult>(result.found).parameters.front();
  EXPECT_EQ(found.verdict, Verdict::determined);
  EXPECT_NEAR(found.value, .35, .05);
  EXPECT_EQ(facts(result).command, "sh run.sh");
  EXPECT_EQ(facts(result).ended_by, "settled");
  EXPECT_EQ(facts(result).failed, 0);
  EXPECT_LT(facts(result).runs, usual_max_runs(1));
  const std::string run = text("out/runs/run_001/run.json");
  EXPECT_THAT(run, AllOf(HasSubstr("\"grains\": 500"), HasSubstr("\"is_wet\": false"),
                         HasSubstr("\"steel\""), HasSubstr("\"unit\": \"deg\"")));
  EXPECT_THAT(row("run_001"), HasSubstr(",ok,a start that fills the bounds evenly"));
  EXPECT_FALSE(fs::exists(place_ / "reading.json"));
}

/// A script whose angle is off by `shift` in the runs that check the fit.
std::string off_in_checks(const char* shift) {
  return fmt::format(
      "{}[ $seed -gt 1000000000 ] && angle=$(awk -v a=$angle 'BEGIN {{ print a + {} }}')\n{}",
      kAngle, shift, kWrite);
}

TEST_F(EngineStudyTest, ChecksTheFitInRunsThatHaveNoPartInIt) {
  const StudyResult result = calibrated(request());
  const auto& joint = std::get<JointResult>(result.found);
  const Agreement& aor = joint.observables.front().verification.value();
  EXPECT_EQ(aor.runs, 6);
  EXPECT_EQ(aor.measured, 22);
  EXPECT_NEAR(aor.simulated, 8 + 40 * joint.parameters.front().value, .5);
  EXPECT_EQ(joint.verdict, AgreementVerdict::agrees);
  EXPECT_FALSE(joint.observables.front().surrogate->misses);
  EXPECT_THAT(joint.agreement.values, ElementsAre(joint.parameters.front().value));
  EXPECT_EQ(facts(result).check_runs, 6);
  EXPECT_EQ(facts(result).check_failed, 0);
  EXPECT_EQ(result.provenance.table->rows, facts(result).runs);
  EXPECT_THAT(text("out/runs/checks.csv"), HasSubstr(",1000000006,ok,checks the fitted"));
  EXPECT_THAT(text("out/runs/runs.csv"), Not(HasSubstr("check")));
  EXPECT_EQ(result_from_json(to_json(result), "text"), result);
  script("exit 1\n");
  calibrated(request());
  EXPECT_FALSE(fs::exists(place_ / "out/runs/check_007")) << "nothing was to be made";
  EXPECT_EQ(joint.parameters.front().interval.low,
            std::get<JointResult>(read_result(place_ / "out")->found).parameters[0].interval.low);
}

TEST_F(EngineStudyTest, ACheckThatReadsOtherwiseDisagrees) {
  script(off_in_checks("6"));
  const auto joint = std::get<JointResult>(calibrated(request()).found);
  EXPECT_EQ(joint.verdict, AgreementVerdict::disagrees);
  EXPECT_TRUE(joint.observables.front().surrogate->misses);
  EXPECT_THAT(joint.warnings, Contains(HasSubstr("aor: the surface missed its own check")));
}

TEST_F(EngineStudyTest, ChecksThatFailSayNothing) {
  script(fmt::format("{}[ $seed -gt 1000000001 ] && exit 3\n{}", kAngle, kWrite));
  const StudyResult result = calibrated(request());
  const auto& joint = std::get<JointResult>(result.found);
  EXPECT_EQ(joint.verdict, std::nullopt);
  EXPECT_EQ(facts(result).check_failed, 5);
  EXPECT_THAT(joint.warnings, Contains(HasSubstr("5 of 6 runs at the fitted parameters failed")));
  EXPECT_THAT(joint.agreement.text, HasSubstr("the fit rests on surfaces"));
}

TEST_F(EngineStudyTest, WhereRepeatsShowNoChanceOneRunChecks) {
  write("mine.csv", "friction,aor\n0.1,12\n0.1,12\n0.2,16\n0.4,24\n0.4,24\n0.6,32\n");
  EngineRequest with = request();
  with.runs = {place_ / "mine.csv"};
  script(std::string("angle=$(awk -v f=$friction 'BEGIN { print 8 + 40 * f }')\n") + kWrite);
  const StudyResult result = calibrated(with);
  EXPECT_EQ(facts(result).check_runs, 1);
  EXPECT_EQ(std::get<JointResult>(result.found).verdict, AgreementVerdict::agrees);
}

TEST_F(EngineStudyTest, MakesNoChecksWhereNoneMayBeMade) {
  write("study.toml", std::string(kStudy) + "check_runs = 0\n");
  EXPECT_EQ(std::get<JointResult>(calibrated(request()).found).verdict, std::nullopt);
  EXPECT_FALSE(fs::exists(place_ / "out/runs/checks.csv"));
  write("study.toml", kStudy);
  EngineRequest none = request();
  none.max_runs = 0;
  EXPECT_EQ(std::get<JointResult>(calibrated(none).found).verdict, std::nullopt);
}

TEST_F(EngineStudyTest, AnInterruptedCheckGoesOn) {
  calibrated(request());
  const std::string checks = text("out/runs/checks.csv"), result = text("out/result.json");
  std::atomic<bool> stop = false;
  const auto none = calibrate_with_engine(
      request("parts"), {.report =
                             [&](const EngineProgress&) {
                               stop = fs::exists(place_ / "parts/runs/check_003/reading.json");
                             },
                         .is_interrupted = &stop});
  EXPECT_FALSE(none.has_value());
  EXPECT_FALSE(fs::exists(place_ / "parts/runs/check_005"));
  calibrated(request("parts"));
  EXPECT_EQ(text("parts/runs/checks.csv"), checks);
  EXPECT_TRUE(text("parts/result.json") == result);
}

TEST_F(EngineStudyTest, AnyNumberOfJobsGivesTheSameBytes) {
  calibrated(request());
  const std::string runs = text("out/runs/runs.csv"), result = text("out/result.json");
  fs::remove_all(place_ / "out");
  EngineRequest three = request();
  three.jobs = 3;
  calibrated(three);
  EXPECT_EQ(text("out/runs/runs.csv"), runs);
  EXPECT_TRUE(text("out/result.json") == result);
}

TEST_F(EngineStudyTest, GoesOnWhereItWasInterrupted) {
  calibrated(request());
  std::atomic<bool> stop = false;
  std::size_t ended = 0;
  for (const std::size_t after : {2U, 4U}) {
    stop = false;
    const auto none = calibrate_with_engine(
        request("parts"), {.report = [&](const EngineProgress& made) { stop = made.made >= after; },
                           .is_interrupted = &stop});
    EXPECT_FALSE(none.has_value());
    EXPECT_FALSE(fs::exists(place_ / "parts/result.json"));
    ended = forecast_of(request("parts")).made;
    EXPECT_EQ(ended, after);
  }
  EXPECT_GT(forecast_of(request("parts")).run_s.value_or(0), 0);
  // The first four runs would now fail if they were repeated.
  script(fmt::format("{}case $folder in *run_00[1-4]) exit 5;; esac\n{}", kAngle, kWrite));
  const StudyResult result = calibrated(request("parts"));
  EXPECT_EQ(text("parts/runs/runs.csv"), text("out/runs/runs.csv"));
  EXPECT_THAT(
      std::get<JointResult>(result.found).warnings,
      Contains(HasSubstr("have changed since 4 of the runs were made (the first: run_001)")));
}

TEST_F(EngineStudyTest, RunsWhoseTableIsGoneAreNotOverwritten) {
  calibrated(request());
  const std::string reading = text("out/runs/run_001/reading.json");
  fs::remove(place_ / "out/runs/runs.csv");
  EXPECT_THAT(error_of([&] { calibrated(request()); }),
              AllOf(HasSubstr("runs.csv"), HasSubstr("is not there"), HasSubstr("put it back")));
  EXPECT_EQ(text("out/runs/run_001/reading.json"), reading);
}

TEST_F(EngineStudyTest, StopsWhereNoneOfTheFirstRunsGivesAReading) {
  script("echo licence server not found >&2; exit 4\n");
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(AllOf(HasSubstr("no reading in its first 3 runs"),
                                                    HasSubstr("exit code 4"),
                                                    HasSubstr("licence server not found"))));
  EXPECT_FALSE(fs::exists(place_ / "out/runs/run_004"));
  // Once that is fixed, these runs are repeated.
  script(std::string(kAngle) + kWrite);
  EXPECT_EQ(facts(calibrated(request())).failed, 0);
}

TEST_F(EngineStudyTest, ARoundOfFailuresIsTheLast) {
  script(fmt::format("{}[ $seed -gt 6 ] && exit 1\n{}", kAngle, kWrite));
  const StudyResult result = calibrated(request());
  EXPECT_EQ(facts(result).ended_by, "failures");
  EXPECT_EQ(facts(result).runs - facts(result).failed, 6);
  EXPECT_LT(facts(result).failed, 9);
  EXPECT_THAT(std::get<JointResult>(result.found).warnings,
              Contains(HasSubstr("No more runs were made: all ")));
}

TEST_F(EngineStudyTest, KeepsToTheLimit) {
  EngineRequest few = request();
  few.max_runs = 7;
  const StudyResult result = calibrated(few);
  EXPECT_EQ(facts(result).runs, 7);
  EXPECT_EQ(facts(result).ended_by, "max_runs");
  few.folder = place_ / "other";
  few.max_runs = 3;
  EXPECT_THAT([&] { calibrated(few); },
              ThrowsMessage<base::InputError>(HasSubstr("max_runs 3. Rule: 6 or more")));
  few.max_runs = 0;  // only a fit to the existing runs
  few.runs = {place_ / "out/runs/runs.csv"};
  EXPECT_EQ(facts(calibrated(few)).runs, 0);
}

TEST_F(EngineStudyTest, TakesRunsOfATableAndChangedRows) {
  write("mine.csv", "friction,aor\n0.1,12.3\n0.2,15.8\n0.3,20.1\n0.4,24.3\n0.5,27.7\n0.7,36.1\n");
  EngineRequest with = request();
  with.runs = {place_ / "mine.csv"};
  const StudyResult result = calibrated(with);
  EXPECT_EQ(result.provenance.table->rows, 6 + facts(result).runs);
  EXPECT_THAT(result.provenance.table->files, ElementsAre("mine.csv", "runs.csv"));
  // A row added by hand is run, under the next free name.
  const std::string before = text("out/runs/runs.csv");
  const int runs = facts(result).runs;
  write("out/runs/runs.csv", before + ",0.65,,,,mine\n");
  const StudyResult more = calibrated(with);
  EXPECT_EQ(facts(more).runs, runs + 1);
  EXPECT_THAT(row(fmt::format("run_{:03}", runs + 1)), HasSubstr(",0.65,33.5"));
  // With another parameter, the existing runs belong to another study.
  write("study.toml",
        std::string(kStudy).replace(std::string(kStudy).find("friction"), 8, "rolling"));
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("another study: they have no rolling"), HasSubstr("--out"))));
  write("study.toml", kStudy);
  write("mine.csv", "fricton,aor\n0.1,12.3\n");
  EXPECT_THAT([&] { calibrated(with); },
              ThrowsMessage<base::InputError>(HasSubstr("Did you mean fricton?")));
}

TEST_F(EngineStudyTest, RunsOfMoreParametersAreThoseOfAnotherStudy) {
  const std::string two = std::string(kStudy).replace(std::string(kStudy).find("[measured]"), 0,
                                                      "rolling = { min = 0, max = 0.3 }\n");
  write("study.toml", two);
  EngineRequest few = request();
  few.max_runs = 9;
  calibrated(few);
  write("study.toml", kStudy);
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("another study: they have a parameter rolling"),
                        HasSubstr("--out"), HasSubstr("put the parameter back"))));
  write("study.toml", two);
  EXPECT_EQ(facts(calibrated(few)).runs, 9);
}

TEST_F(EngineStudyTest, ScriptsWithQuotedNamesAreWatched) {
  const std::string study = std::string(kStudy).replace(std::string(kStudy).find("sh run.sh"), 9,
                                                        "PART='my script.sh'; sh 'my script.sh'");
  write("study.toml", study);
  write("my script.sh", kRead + std::string(kAngle) + kWrite);
  EngineRequest few = request();
  few.max_runs = 6;
  calibrated(few);
  EXPECT_THAT(text("out/runs/run_001/run.json"), HasSubstr("\"my script.sh\": "));
  write("my script.sh", std::string(kRead) + kAngle + kWrite + "# changed\n");
  calibrated(few);
  EXPECT_THAT(notes_, Contains(HasSubstr("have changed since 6 of the runs were made")));
}

TEST_F(EngineStudyTest, TheResultIsTheSameInAnyFolder) {
  script(fmt::format("{}[ $seed = 4 ] && exit 1\n{}", kAngle, kWrite));
  EngineRequest few = request();
  few.max_runs = 7;
  calibrated(few);
  script(fmt::format("{}[ $seed = 4 ] && exit 2\n{}", kAngle, kWrite));
  calibrated(few);
  const std::string result = text("out/result.json");
  EXPECT_THAT(result, HasSubstr("have changed since 7"));
  EXPECT_THAT(result, Not(HasSubstr(place_.filename().string().substr(0, 4))));
  fs::rename(place_ / "out", place_ / "another name");
  few.folder = place_ / "another name";
  calibrated(few);
  EXPECT_TRUE(text("another name/result.json") == result);
}

TEST_F(EngineStudyTest, RunsThatFailedAreMadeAgainOnceTheirStatusIsEmptied) {
  script(fmt::format("{}[ $seed -lt 7 ] && [ $seed -gt 3 ] && exit 1\n{}", kAngle, kWrite));
  EngineRequest few = request();
  few.max_runs = 6;
  EXPECT_THAT(error_of([&] { calibrated(few); }),
              AllOf(HasSubstr("has readings at 3 different places"), HasSubstr("--max-runs"),
                    HasSubstr("3 of 6 failed"), HasSubstr("status is emptied in runs/runs.csv")));
  script(std::string(kAngle) + kWrite);
  few.max_runs = 9;
  const StudyResult result = calibrated(few);
  EXPECT_EQ(facts(result).failed, 3);
  EXPECT_THAT(std::get<JointResult>(result.found).warnings,
              Contains(HasSubstr("3 of them failed: those whose status is emptied in")));
  std::string table = text("out/runs/runs.csv");
  for (std::size_t at = 0; (at = table.find(",failed,")) != std::string::npos;) {
    table.replace(at, 8, ",,");
  }
  write("out/runs/runs.csv", table);
  const StudyResult again = calibrated(few);
  EXPECT_EQ(facts(again).failed, 0);
  EXPECT_EQ(facts(again).runs, 9);
}

TEST_F(EngineStudyTest, OtherNumbersAreColumns) {
  script(
      fmt::format("{}echo \"{{\\\"aor\\\": $angle, \\\"zeta\\\": $seed, \\\"beta\\\": $seed, "
                  "\\\"seed\\\": 77, \\\"comment\\\": \\\"x\\\"}}\" > \"$folder/reading.json\"\n",
                  kAngle));
  calibrated(request());
  EXPECT_THAT(text("out/runs/runs.csv"),
              ::testing::StartsWith("run,friction,aor,seed,status,beta,zeta,reason\nrun_001,"));
  EXPECT_THAT(row("run_003"), HasSubstr(",3,ok,3,3,"));
}

TEST_F(EngineStudyTest, PicturesAreMeasured) {
  testing::HeapScene scene;
  vision::write_picture(place_ / "heap.png", testing::draw_heap(scene).picture);
  script(
      fmt::format("{}cp heap.png \"$folder/view.png\"\nif [ $seed = 2 ]; then : > "
                  "\"$folder/view.png\"; fi\n"
                  "[ $((seed % 4)) = 3 ] && angle='\"view.png\"'\n"
                  "[ $seed = 2 ] && angle='\"view.png\"'\n{}",
                  kAngle, kWrite));
  const StudyResult result = calibrated(request());
  EXPECT_THAT(row("run_003"), HasSubstr(",run_003/view.png,3,ok,"));
  EXPECT_THAT(row("run_002"), HasSubstr(",,2,failed,"));
  EXPECT_THAT(notes_, Contains(AllOf(HasSubstr("run_002 failed"), HasSubstr("view.png"))));
  EXPECT_EQ(facts(result).failed, 1);
}

TEST_F(EngineStudyTest, FaultsOfTheStudyAreToldTogether) {
  write("study.toml",
        "[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 1, sd = 1, n = 2 }\n"
        "[engine]\ntimeout_s = -1\nmax_runs = 0\nsettings = 3\nnodes = 2\n");
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("engine.command is missing"), HasSubstr("timeout_s = -1"),
                        HasSubstr("max_runs = 0"), HasSubstr("settings = 3"), HasSubstr("nodes"))));
  write("study.toml",
        "[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 1, sd = 1, n = 2 }\n");
  EXPECT_THAT([&] { calibrated(request()); },
              ThrowsMessage<base::InputError>(HasSubstr("has no [engine]")));
}

}  // namespace
}  // namespace repose::calibrate
