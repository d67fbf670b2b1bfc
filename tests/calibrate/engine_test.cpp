// Studies whose runs a command makes.
#include "calibrate/engine/engine.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/engine/engine_runs.h"
#include "calibrate/engine/engine_study.h"
#include "calibrate/engine/make_runs.h"
#include "calibrate/result/result.h"
#include "calibrate/runs/table_study.h"
#include "tests/support/heap_picture.h"
#include "tests/support/temporary_folder.h"
#include "vision/picture/picture.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr const char* kStudy =
    "[parameter]\n"
    "friction = { min = 0.1, max = 0.7 }\n"
    "[measured]\n"
    "aor = { mean = 22, sd = 1, n = 4, unit = \"deg\" }\n"
    "[engine]\n"
    "command = \"sh run.sh\"\n"
    "settings = { grains = 500, walls = [\"steel\"], is_wet = false }\n";

/// Sets $folder, $friction and $seed of a run.
constexpr const char* kRead =
    "folder=$1\n"
    "number() { sed -n \"s/^ *\\\"$1\\\": \\([-0-9.e]*\\),*$/\\1/p\" \"$folder/run.json\"; }\n"
    "friction=$(number friction); seed=$(number seed)\n";

/// The angle follows a formula, with something that looks like chance.
constexpr const char* kAngle =
    "angle=$(awk -v f=$friction -v s=$seed 'BEGIN { print 8 + 40 * f + .5 * sin(37 * s) }')\n";
constexpr const char* kWrite = "echo \"{\\\"aor\\\": $angle}\" > \"$folder/reading.json\"\n";

/// A folder whose name a shell would take apart.
class EngineTest : public ::testing::Test {
 protected:
  EngineTest() {
    fs::create_directories(place_);
    write("study.toml", kStudy);
    script(std::string(kAngle) + kWrite);
  }

  void write(const std::string& name, const std::string& text) const {
    folder_.write(fmt::format("it's a \"folder\" $1/{}", name), text);
  }
  void script(const std::string& text) const { write("run.sh", kRead + text); }
  std::string text(const std::string& name) const { return testing::text_of(place_ / name); }

  EngineRequest request(const std::string& out = "out") const {
    return {.study = place_ / "study.toml", .folder = place_ / out};
  }
  StudyResult calibrated(const EngineRequest& of) {
    auto result = calibrate_with_engine(
        of, {.note = [this](const std::string& note) { notes_.push_back(note); }});
    return std::move(result).value();
  }
  static EngineFacts facts(const StudyResult& of) { return of.provenance.table->engine.value(); }

  /// The row of a run.
  std::string row(const std::string& run, const std::string& out = "out") const {
    const std::string table = text(out + "/runs/runs.csv");
    const std::size_t start = table.find(run + ',');
    return start == std::string::npos ? "" : table.substr(start, table.find('\n', start) - start);
  }

  testing::TemporaryFolder folder_;
  fs::path place_ = folder_.path() / "it's a \"folder\" $1";
  std::vector<std::string> notes_;
};

using EngineStudyTest = EngineTest;

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

/// What is measured where the angle is off by `shift` in the runs that check the fit.
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
  // A program that failed from here on would show which runs are made again.
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
  // Once that is mended these runs are made again.
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
  few.max_runs = 0;  // a fit to what there is
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
  // A row that somebody adds is made, by the name that is next.
  const std::string before = text("out/runs/runs.csv");
  const int runs = facts(result).runs;
  write("out/runs/runs.csv", before + ",0.65,,,,mine\n");
  const StudyResult more = calibrated(with);
  EXPECT_EQ(facts(more).runs, runs + 1);
  EXPECT_THAT(row(fmt::format("run_{:03}", runs + 1)), HasSubstr(",0.65,33.5"));
  // Others are those of another study.
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

/// What becomes of one run.
class OneRunTest : public EngineTest {
 protected:
  /// Why it failed; empty: it did not.
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
