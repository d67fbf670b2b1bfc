#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/wait.h>

#include "cli/calibrate/calibrate_options.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/cli/calibrate_command_test.h"
#include "tests/support/heap_picture.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Calibrate = CalibrateCommandTest;
using CalibrateKilled = Calibrate;
using CalibrateRanks = Calibrate;
using CalibrateSheets = Calibrate;

TEST_F(Calibrate, GivesCoefficientsWithIntervalsAndVerdicts) {
  const Finished done = run({"study.toml", "--json", "result.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out,
              AllOf(HasSubstr("particle_wall.restitution"), HasSubstr("determined"),
                    HasSubstr("drop [mm]"), HasSubstr("These coefficients are valid for: ")));
  const json result = json::parse(text("result.json"));
  ASSERT_EQ(result["parameters"].size(), 2U);
  const json& friction = result["parameters"][1];
  EXPECT_EQ(friction["name"], "contact.particle_wall.sliding_friction");
  EXPECT_EQ(friction["verdict"], "determined");
  EXPECT_LT(friction["interval"][0], friction["value"]);
  EXPECT_GT(friction["interval"][1], friction["value"]);
  EXPECT_EQ(result["observables"][0]["name"], "drop");
  EXPECT_NEAR(result["observables"][1]["measured"], 20.475, 1e-9);
  for (const char* key : {"equivalence_family", "provenance", "correlation", "rounds", "runs",
                          "responses", "surfaces"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  EXPECT_EQ(text("study_calibration/result.json"), text("result.json"));
  const json& regression = result["regressions"][0];
  EXPECT_EQ(regression["observable"], "drop");
  EXPECT_GT(regression["regression"]["anova"]["model"]["f"], 10);
}

TEST_F(Calibrate, WhatTheStudyMarksAsAssumedStaysSo) {
  const std::string mark = "study.assumed=[\"particle.density_kg_m3\", \"wall.poisson_ratio\"]";
  const Finished done = run({"study.toml", "--set", mark});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("Assumed in the study, not measured: particle.density_kg_m3"));
  EXPECT_EQ(json::parse(text("study_calibration/result.json"))["provenance"]["assumed"],
            json::parse(R"(["particle.density_kg_m3", "wall.poisson_ratio"])"));
  ASSERT_EQ(run_repose(folder_, {"report", "study_calibration"}).exit_code, 0);
  const std::string protocol = text("study_calibration/tables/protocol.csv");
  const auto cells_of = [&](const std::string& row) {
    const std::size_t start = protocol.find(row);
    return protocol.substr(start, protocol.find('\n', start) - start);
  };
  // Item, stated values, assumed values, measured values.
  EXPECT_THAT(cells_of("grain:"), ::testing::ContainsRegex("ratio [0-9.]+\",density [0-9]+ kg"));
  EXPECT_THAT(cells_of("wall:"), ::testing::ContainsRegex("Pa,Poisson's ratio [0-9.]+,"));
}

TEST_F(Calibrate, WeighsRollingModelsAgainstEachOther) {
  const Finished done = run({"study.toml", "--rolling-models", "constant_torque,elastic_plastic"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("score: means"), HasSubstr("elastic_plastic")));
  for (const char* model : {"constant_torque", "elastic_plastic"}) {
    const json result =
        json::parse(text(std::string("study_calibration/") + model + "/result.json"));
    EXPECT_EQ(result["provenance"]["rolling_model"], model);
    ASSERT_EQ(result["candidates"].size(), 2U);
    EXPECT_EQ(result["candidates"][0]["name"], "constant_torque");
    EXPECT_GE(result["candidates"][1]["score_of_means"], 0);
  }
}

TEST_F(Calibrate, WeighsRollingModelsAgainFromTheirFolders) {
  const Words words = {"study.toml", "--rolling-models", "constant_torque,elastic_plastic"};
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string first = text("study_calibration/elastic_plastic/result.json");
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(text("study_calibration/elastic_plastic/result.json"), first);
}

TEST_F(Calibrate, PredictsWhatIsHeldOut) {
  const std::string held_out = "experiment.tilt.held_out = true";
  const Finished done = run({"study.toml", "--set", held_out, "--json", "result.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("held out"), HasSubstr("95 % interval")));
  const json result = json::parse(text("result.json"));
  ASSERT_EQ(result["held_out"].size(), 1U);
  EXPECT_EQ(result["held_out"][0]["name"], "tilt");
  EXPECT_EQ(result["held_out"][0]["possible"].size(), 2U);
  EXPECT_THAT(done.out, HasSubstr("was possible"));
  EXPECT_EQ(result["observables"].size(), 1U);
  const Finished dry = run({"study.toml", "--set", held_out, "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_THAT(dry.out, HasSubstr("0 + 16"))
      << "nothing for the fit, eight predictions, eight all over the bounds";
  EXPECT_EQ(run({"study.toml", "--set", "experiment.tilt.held_out = 1"}).exit_code, 2);
}

TEST_F(Calibrate, ShowsWhatStifferGrainsChange) {
  const std::string softened = "experiment.drop.stiffness_factor = 0.25";
  const Finished done = run({"study.toml", "--set", softened, "--json", "result.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("stiffer grains"), HasSubstr("stiffness_factor")));
  const json result = json::parse(text("result.json"));
  ASSERT_EQ(result["stiffness_checks"].size(), 1U);
  EXPECT_EQ(result["stiffness_checks"][0]["name"], "drop");
  EXPECT_EQ(result["stiffness_checks"][0]["runs"], 24);
  EXPECT_NE(result["stiffness_checks"][0]["verdict"], "disagrees")
      << "restitution does not depend on stiffness";
  EXPECT_THAT(done.out, HasSubstr("coefficient with stiffer grains"));
  EXPECT_EQ(result["stiffer_coefficients"].size(), result["parameters"].size());
  const auto stiffer_runs = [&](const Words& words) {
    const json times = json::parse(run(words).out);
    for (const json& phase : times["budgets"][0]["phases"]) {
      if (phase["phase"] == "stiffer grains") return phase["runs"].get<int>();
    }
    return -1;
  };
  EXPECT_EQ(stiffer_runs({"study.toml", "--dry-run", "--json", "-"}), 0);
  EXPECT_EQ(stiffer_runs({"study.toml", "--set", softened, "--dry-run", "--json", "-"}), 24)
      << "they are among the simulations that it counts";
  EXPECT_THAT(done.err, HasSubstr("stiffer grains 24 (")) << "and that are announced";
}

TEST_F(Calibrate, ShowsWhatMoreSpheresChange) {
  const Finished done = run({"study.toml", "--set", "particle.size_mm = [22, 18, 16]", "--set",
                             "particle.spheres = 2", "--json", "result.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("more spheres"), HasSubstr("coefficient with more spheres"),
                              HasSubstr("what more spheres than 2 change in a reading")));
  const json shape = json::parse(text("result.json"))["shape_check"];
  EXPECT_EQ(shape["spheres"], 2);
  EXPECT_EQ(shape["finer_spheres"], 8);
  EXPECT_TRUE(shape["not_made"].is_null());
  ASSERT_EQ(shape["readings"].size(), 2U);
  EXPECT_EQ(shape["readings"][0]["name"], "drop");
  EXPECT_EQ(shape["coefficients"].size(), 2U);
  const Finished ball = run({"study.toml", "--json", "ball.json"});
  ASSERT_EQ(ball.exit_code, 0) << ball.err;
  EXPECT_THAT(ball.out, HasSubstr("was not checked: one sphere is exactly the shape"));
  EXPECT_EQ(json::parse(text("ball.json"))["shape_check"]["readings"].size(), 0U);
}

TEST_F(Calibrate, RefusesRollingModelsThatCannotBeWeighed) {
  const Finished done =
      run({"study.toml", "--rolling-models", "constant_torque,sliding", "--method", "paper",
           "--json", "-", "--set", "contact.rolling_model=\"none\""});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("--rolling-models sliding"), HasSubstr("two or more"),
                              HasSubstr("--method paper"), HasSubstr("leave out --json"),
                              HasSubstr("contradicts --rolling-models")));
  EXPECT_FALSE(exists("study_calibration")) << "nothing is begun";
}

TEST_F(CalibrateSheets, CountAsIfTheirReadingsWereListed) {
  std::string study = calibrate::test::kSphereStudy;
  const std::string values = "values = [20.1, 21.3, 20.7, 19.8]";
  study.replace(study.find(values), values.size(), "readings = \"tilts.csv\"");
  folder_.write("sheet.toml", study);
  folder_.write("tilts.csv", std::string("angle_deg\n"));
  const Finished empty = run({"sheet.toml"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.err, HasSubstr("tilts.csv: no readings yet: fill in"));
  EXPECT_FALSE(exists("sheet_calibration")) << "nothing is begun";

  folder_.write("tilts.csv", std::string("angle_deg;note\n20,1;\n21,3;\n20,7;damp\n19,8;\n"));
  const json by_sheet = result({"sheet.toml", "--out", "runs"});
  const json by_hand = result({"study.toml", "--out", "runs"});
  EXPECT_EQ(by_sheet["observables"], by_hand["observables"]);
  EXPECT_EQ(by_sheet["parameters"], by_hand["parameters"]);
}

TEST_F(Calibrate, TheReportIsCalledAsTheStudySays) {
  folder_.write("study.toml",
                "[study]\ntitle = \"Balls & <walls>\"\nauthor = \"A. Smith\"\ndate = \"May 2026\"\n"
                "note = \"a dry day\"\n" +
                    calibrate::test::kSphereStudy);
  ASSERT_EQ(run({"study.toml", "--out", "d"}).exit_code, 0);
  ASSERT_EQ(run_repose(folder_, {"report", "d"}).exit_code, 0);
  const std::string page = text("d/report.html");
  EXPECT_THAT(
      page, AllOf(HasSubstr("<h1>Balls &amp; &lt;walls&gt;</h1>"), HasSubstr("<p>a dry day</p>")));
  EXPECT_THAT(page, HasSubstr("<p>A. Smith, May 2026.</p>"));
}

TEST_F(CalibrateKilled, AgainAndAgainEndsWithTheSameBytes) {
  ASSERT_EQ(run({"study.toml", "--out", "whole", "--jobs", "1"}).exit_code, 0);
  int kills = 0;
  for (const std::size_t files : {2U, 6U, 12U, 20U, 30U}) {
    const pid_t program =
        start_repose(folder_, {"calibrate", "study.toml", "--out", "killed", "--jobs", "2"});
    int status = 0;
    while (files_in("killed/runs") < files && ::waitpid(program, &status, WNOHANG) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(program, SIGKILL);
    ::waitpid(program, &status, 0);
    // On a busy machine it may have finished before this loop looked.
    if (std::filesystem::remove(path("killed/result.json"))) break;
    ++kills;
  }
  ASSERT_GT(kills, 0) << "it was too fast";
  const Finished last = run({"study.toml", "--out", "killed", "--jobs", "2"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("simulations were taken from killed/runs"));
  EXPECT_EQ(text("killed/result.json"), text("whole/result.json"));
}

/// Restricts this process, and programs it starts, to one core, as a cluster does for a job.
class OneCore {
 public:
  OneCore() {
    cpu_set_t one;
    CPU_ZERO(&one);
    sched_getaffinity(0, sizeof all_, &all_);
    int core = 0;
    while (!CPU_ISSET(core, &all_)) ++core;
    CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~OneCore() { sched_setaffinity(0, sizeof all_, &all_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;
  OneCore(OneCore&&) = delete;
  OneCore& operator=(OneCore&&) = delete;

 private:
  cpu_set_t all_ = {};
};

TEST_F(Calibrate, TakesTheCoresThatItMayUse) {
  const OneCore one_core;
  // Not run(): its server has all cores.
  const Finished done = run_program(program(), folder_, {"calibrate", "study.toml", "--dry-run"});
  EXPECT_THAT(done.out, HasSubstr("time at most, 1 core "));
  EXPECT_THAT(done.err, IsEmpty());
}

TEST_F(Calibrate, AnotherStudyFindsTheRunsThatItShares) {
  ASSERT_EQ(run({"study.toml", "--out", "runs"}).exit_code, 0);
  const std::string first = text("runs/result.json");
  const Finished other = run({"study.toml", "--out", "runs", "--set",
                              "experiment.drop.measured = { mean = 26, sd = 1, n = 5 }"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.err, AllOf(HasSubstr("simulations were taken from"),
                               HasSubstr("runs/result.json: belonged to another study")));
  EXPECT_NE(text("runs/result.json"), first);
  bool is_saved = false;
  for (const auto& entry : std::filesystem::directory_iterator(path("runs"))) {
    is_saved = is_saved || (entry.is_regular_file() && text_of(entry.path()) == first);
  }
  EXPECT_TRUE(is_saved) << "under another name";
}

TEST_F(Calibrate, EveryErrorIsToldAtOnce) {
  const Finished wrong =
      run({"study.toml", "--budget", "cheap", "--method", "best", "--jobs", "0", "--set",
           "contact.particle_wall.restitution = { min = 0.9, max = 0.2 }"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.out, IsEmpty());
  EXPECT_THAT(wrong.err,
              AllOf(HasSubstr("budget (--budget) = cheap: must be quick, standard or paper"),
                    HasSubstr("--method best: must be joint or paper"),
                    HasSubstr("--jobs 0: must be a whole number"), HasSubstr("min below max")));
  EXPECT_FALSE(exists("study_calibration"));
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"none.toml"}).exit_code, 2);
}

TEST_F(Calibrate, AFolderThatCannotBeMadeIsRefused) {
  folder_.write("runs", std::string("a file where the folder should be"));
  const Finished refused = run({"study.toml", "--out", "runs"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("runs: the folder cannot be created"));
  EXPECT_EQ(text("runs"), "a file where the folder should be");
}

TEST_F(Calibrate, AFullDiskLosesNothing) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer begins by writing a file of its own";
#endif
  // Files are limited to 4 KiB: runs are smaller, the clump and the result are larger.
  folder_.write("full.sh", std::string("trap '' XFSZ; ulimit -f 8\n"
                                       "exec '") +
                               program().string() + "' calibrate study.toml --out runs\n");
  const Finished at_once = run_program("sh", folder_, {"full.sh"});
  EXPECT_EQ(at_once.exit_code, 2) << "before anything is simulated";
  EXPECT_THAT(at_once.err, AllOf(HasSubstr("runs/clump.json"), HasSubstr("Fix: ")));
  ASSERT_EQ(run({"study.toml", "--out", "runs"}).exit_code, 0);
  const std::string result = text("runs/result.json");
  std::filesystem::remove(path("runs/result.json"));
  const Finished full = run_program("sh", folder_, {"full.sh"});
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("runs/result.json"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("runs/result.json")) << "not even half of it";
  const Finished again = run({"study.toml", "--out", "runs"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("simulations were taken from"));
  EXPECT_EQ(text("runs/result.json"), result);
}

TEST_F(Calibrate, PicturesThatAreMissingAreNamed) {
  const Finished refused =
      run({"study.toml", "--set", "experiment.heap.measured = { pictures = [\"none.jpg\"] }"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("none.jpg"));
}

TEST_F(Calibrate, PicturesWithoutAHeapAreNoMeasurement) {
  constexpr int kWidth = 320, kHeight = 240;
  const vision::Picture blank{
      .width = kWidth,
      .height = kHeight,
      .bgr = std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight, 255)};
  vision::write_picture(path("blank.png"), blank);
  const Finished refused =
      run({"study.toml", "--set", "experiment.heap.measured = { pictures = [\"blank.png\"] }"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("none of the 1 pictures of the heap could be measured"),
                                 HasSubstr("blank.png: no heap stands out")));
}

TEST_F(Calibrate, PicturesAreReadByTheDefinitionOfTheStudy) {
  HeapScene scene;
  scene.width = 600;
  scene.height = 400;
  vision::write_picture(path("heap.png"), draw_heap(scene).picture);
  const vision::ReposeAngle measured =
      vision::measure_repose_angle(vision::read_picture(path("heap.png")));
  const auto angle_deg = [&](std::vector<std::string> settings) {
    settings.emplace_back("experiment.heap.measured = { pictures = [\"heap.png\"] }");
    cli::CalibrateArguments arguments;
    arguments.study = path("study.toml").string();
    arguments.settings = settings;
    const cli::CalibratePlan plan = cli::read_bench(arguments, calibrate::NoRows::refused);
    EXPECT_THAT(plan.errors, IsEmpty());
    return plan.record.measurement.pictures.at(0).angle_deg.value();
  };
  const auto by = [&](const char* name) {
    return vision::angle_by(measured, name).value() * 180 / std::numbers::pi;
  };
  EXPECT_NEAR(angle_deg({}), by(""), 1e-5);
  EXPECT_NEAR(angle_deg({"experiment.heap.definition = \"height_over_base\""}),
              by("height_over_base"), 1e-5);
  EXPECT_GT(std::abs(by("height_over_base") - by("")), .01);
}

TEST_F(Calibrate, ThePapersWayNeedsWhatItsStepsNeed) {
  const Finished refused = run({"study.toml", "--method", "paper"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("the published method: finds restitution, sliding and rolling"),
                    HasSubstr("--method joint")));
}

TEST_F(CalibrateRanks, GiveTheBytesOfOneProcess) {
  const Words of_one = {"study.toml", "--out", "one"};
  ASSERT_EQ(run(of_one).exit_code, 0);
  for (const char* ranks : {"2", "4"}) {
    const std::string out = std::string("ranks") + ranks;
    // MPI's own libraries leak, and are already unloaded when the sanitizer would name them.
    const Finished done = run_program(
        "mpirun", folder_,
        {"--allow-run-as-root", "--oversubscribe", "-np", ranks, "env",
         "ASAN_OPTIONS=detect_leaks=0", program(), "calibrate", "study.toml", "--out", out});
    if (done.exit_code == 127) GTEST_SKIP() << "there is no mpirun";
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(text(out + "/result.json"), text("one/result.json")) << ranks;
  }
}

TEST_F(CalibrateRanks, AStudyGoesOnAfterOneWasKilled) {
  ASSERT_EQ(run({"study.toml", "--out", "one"}).exit_code, 0);
  // On a busy machine it may finish before it is killed: then try again.
  const std::string script =
      "for attempt in 1 2 3 4 5; do\n"
      "  rm -rf ranks\n"
      "  mpirun --allow-run-as-root --oversubscribe -np 3 '" +
      program().string() +
      "' calibrate study.toml --out ranks & launcher=$!\n"
      "  until ls ranks/runs/*.json >/dev/null 2>&1; do sleep 0.01; done\n"
      "  for child in $(ps -o pid= --ppid $launcher); do kill -KILL $child; break; done\n"
      "  wait $launcher || exit 1\n"
      "done\n";
  folder_.write("killing.sh", "command -v mpirun ps >/dev/null || exit 127\n" + script);
  const Finished killed = run_program("sh", folder_, {"killing.sh"});
  if (killed.exit_code == 127) GTEST_SKIP() << "there is no mpirun or no ps";
  EXPECT_NE(killed.exit_code, 0) << "it was too fast";
  ASSERT_FALSE(exists("ranks/result.json"));
  const Finished last = run({"study.toml", "--out", "ranks"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("simulations were taken from"));
  EXPECT_EQ(text("ranks/result.json"), text("one/result.json"));
}

}  // namespace
}  // namespace repose::testing
