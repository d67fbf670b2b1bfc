#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"
#include "tests/support/run_program.h"
#include "tests/support/soft_study.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// A soft ball and short distances: a run takes a fraction of a second.
const std::string kSimulatedStudy = calibrate::test::kSoftBall + R"([contact.particle_wall]
restitution = 0.5
sliding_friction = 0.4
rolling_friction = 0.1
[contact.particle_particle]
restitution = { min = 0.01, max = 0.4 }
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 50
grains = 2
measured = { values = [9.1, 9.7, 9.4] }
[experiment.roll]
release_mm = 20
[experiment.heap]
grains = 40
)";

/// Grains of two spheres, in random poses.
const Words kAsNuts = {"--set", "particle.size_mm=[22,18,18]", "--set", "particle.spheres=2"};

class Simulate : public CommandTest {
 protected:
  Simulate() : CommandTest({"simulate"}) { folder_.write("study.toml", kSimulatedStudy); }

  json timeless(const Words& words) const { return without_times(result(words)); }
};

TEST_F(Simulate, ADropGivesAValueAndWhatItBelongsTo) {
  const Finished finished = run(with({"drop", "study.toml", "--repeats", "2"}, kAsNuts));
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_THAT(finished.err, IsEmpty()) << "no progress where there is no terminal";
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("95 % interval of the mean"), HasSubstr("measured 9.400 mm"),
                    HasSubstr("lowest_point_rise_mm"), HasSubstr("constant_torque"),
                    HasSubstr("2 spheres"), HasSubstr("stiffness factor")));
}

TEST_F(Simulate, APartOfAnotherMaterialIsToldWhereTheBenchHasIt) {
  const Words inclined = {
      "--set", "wall.incline={name=\"wood\",young_modulus_pa=1e7,poisson_ratio=0.4}", "--set",
      "contact.particle_incline={restitution=0.5,sliding_friction=0.4,rolling_friction=0.2}"};
  const json roll = timeless(with({"roll", "study.toml"}, inclined));
  EXPECT_EQ(roll["materials"]["incline"]["name"], "wood");
  EXPECT_EQ(roll["contact"]["particle_incline"]["rolling_friction"], .2);
  EXPECT_LT(roll["value"], timeless({"roll", "study.toml"})["value"]);
  EXPECT_THAT(run(with({"roll", "study.toml"}, inclined)).out,
              AllOf(HasSubstr("with the incline"), HasSubstr("rolling friction 0.2")));
  const json drop = timeless(with({"drop", "study.toml"}, inclined));
  EXPECT_FALSE(drop["contact"].contains("particle_incline"));
  EXPECT_EQ(drop["value"], timeless({"drop", "study.toml"})["value"]);
}

TEST_F(Simulate, OneRepeatHasNoInterval) {
  EXPECT_THAT(run({"roll", "study.toml"}).out,
              AllOf(HasSubstr("Only one repeat: no standard deviation or interval"),
                    Not(HasSubstr("95 %"))));
  EXPECT_TRUE(timeless({"roll", "study.toml"})["interval"].is_null());
}

TEST_F(Simulate, RepeatsThatAreTheSameHaveNoInterval) {
  const Words words = {"tilt",      "study.toml", "--set", "experiment.tilt={rate_deg_s=10}",
                       "--repeats", "2"};
  const Finished finished = run(words);
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("n = 2, all identical: no scatter"), Not(HasSubstr("95 %"))));
  EXPECT_THAT(finished.err, HasSubstr("repose: all 2 repeats gave the same value"));
  const json tilt = timeless(words);
  EXPECT_TRUE(tilt["value"].is_number());
  EXPECT_TRUE(tilt["interval"].is_null());
  EXPECT_TRUE(tilt["sd"].is_null());
  EXPECT_EQ(tilt["warnings"][0]["code"], "no_scatter");
  EXPECT_TRUE(tilt["warnings"][0]["seed"].is_null());
}

TEST_F(Simulate, JsonHasTheContractsKeys) {
  const Finished finished =
      run(with({"drop", "study.toml", "--repeats", "2", "--json", "-"}, kAsNuts));
  const json drop = json::parse(finished.out);
  EXPECT_EQ(drop["experiment"], "drop");
  EXPECT_EQ(drop["unit"], "mm");
  ASSERT_EQ(drop["repeats"].size(), 2U);
  const double a = drop["repeats"][0]["value"], b = drop["repeats"][1]["value"];
  EXPECT_NE(a, b) << "seeds differ";
  EXPECT_DOUBLE_EQ(drop["value"].get<double>(), (a + b) / 2);
  EXPECT_LT(drop["interval"][0], drop["value"]);
  EXPECT_GT(drop["interval"][1], drop["value"]);
  for (const char* key : {"seed", "value", "wall_s", "steps", "clump_steps_per_s", "timestep_s",
                          "state", "readings"}) {
    EXPECT_TRUE(drop["repeats"][0].contains(key)) << key;
  }
  EXPECT_TRUE(drop["repeats"][0]["state"].is_null());
  EXPECT_EQ(drop["clump"]["spheres"], 2);
  EXPECT_EQ(drop["stiffness_factor"], 1);
  EXPECT_EQ(drop["rolling_model"], "constant_torque");
  EXPECT_EQ(drop["measured"]["n"], 3);
  EXPECT_NEAR(drop["measured"]["mean"].get<double>(), 9.4, 1e-12);
  EXPECT_EQ(drop["study"]["hash"].get<std::string>().size(), 36U);
  EXPECT_THAT(drop["program"].get<std::string>(), HasSubstr("repose "));
}

TEST_F(Simulate, OurOwnEngineIsTheOneUnlessAnotherIsAskedFor) {
  const json drop = timeless({"drop", "study.toml"});
  EXPECT_TRUE(drop["engine"].is_null());
  EXPECT_EQ(timeless({"drop", "study.toml", "--engine", "repose"})["value"], drop["value"]);
}

TEST_F(Simulate, AnEngineThatThereIsNotIsAnError) {
  const Finished option = run({"drop", "study.toml", "--engine", "ligghts"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, AllOf(HasSubstr("\"ligghts\" is not known"),
                                HasSubstr("Fix: program = \"liggghts\".")));
  const Finished key = run({"drop", "study.toml", "--set", "engine.program=\"ligghts\""});
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_THAT(key.err, HasSubstr("engine.program = \"ligghts\" is not known"));
  const Finished processes = run({"drop", "study.toml", "--processes", "0"});
  EXPECT_EQ(processes.exit_code, 2);
  EXPECT_THAT(processes.err, HasSubstr("engine.processes = 0"));
}

// Our own engine keeps them where they fell.
TEST_F(Simulate, GrainsThatLiggghtsLosesOffThePlateAreWarnedOf) {
  if (run_program("liggghts", {}, {"-in", "/dev/null", "-log", "none"}).exit_code != 0) {
    GTEST_SKIP() << "liggghts is not installed. Fix: apt-get install liggghts";
  }
  folder_.write("rough.toml", kSoftBalls + "[contact]\nrolling_model = \"elastic_plastic\"\n" +
                                  kRoughContacts + R"([experiment.heap]
tube_diameter_mm = 90
tube_height_mm = 420
plate_mm = 160
grains = 200
lift_speed_mm_s = 200
)");
  const json heap = result({"heap", "rough.toml", "--engine", "liggghts"});
  const json& readings = heap["repeats"][0]["readings"];
  EXPECT_GT(readings["grains_off_plate"], 20);
  EXPECT_EQ(readings["grains_off_plate"].get<double>() + readings["grains_on_plate"].get<double>(),
            readings["grains"].get<double>());
  const auto& warnings = heap["warnings"];
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const json& warning) {
    return warning["code"] == "grains_off_plate" &&
           warning["message"].get<std::string>().find("a larger plate") != std::string::npos;
  })) << warnings;
}

TEST_F(Simulate, ThreadsDoNotChangeTheResult) {
  for (const char* repeats : {"1", "3"}) {
    EXPECT_EQ(timeless({"roll", "study.toml", "--repeats", repeats, "--threads", "1"}),
              timeless({"roll", "study.toml", "--repeats", repeats, "--threads", "7"}))
        << "seven threads for three repeats: two each";
  }
}

TEST_F(Simulate, RepeatsTakeSeedsThatFollow) {
  const json both = timeless({"drop", "study.toml", "--seed", "8", "--repeats", "2"});
  EXPECT_EQ(both["repeats"][0]["seed"], 8);
  EXPECT_EQ(both["repeats"][1], timeless({"drop", "study.toml", "--seed", "9"})["repeats"][0]);
}

TEST_F(Simulate, SettingsReachTheRun) {
  const json usual = timeless({"drop", "study.toml"});
  const json hard =
      timeless({"drop", "study.toml", "--set", "contact.particle_wall.restitution=0.9", "--set",
                "contact.rolling_model=\"none\""});
  EXPECT_GT(hard["value"], usual["value"]);
  EXPECT_EQ(hard["rolling_model"], "none");
  EXPECT_EQ(hard["study"]["settings"][0], "contact.particle_wall.restitution=0.9");
  EXPECT_NE(hard["study"]["hash"], usual["study"]["hash"]);
}

TEST_F(Simulate, OutHoldsStatesAndTheResult) {
  const json printed = timeless({"drop", "study.toml", "--repeats", "2", "--out", "new/runs"});
  const auto runs = path("new") / "runs";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(runs)) {
    names.push_back(entry.path().filename());
  }
  EXPECT_THAT(names, UnorderedElementsAre("drop_seed_1.vtp", "drop_seed_2.vtp", "runs", "run.json",
                                          "result.json"));
  EXPECT_EQ(json::parse(text_of(runs / "result.json"))["value"], printed["value"]);
  EXPECT_EQ(printed["repeats"][0]["state"], "new/runs/drop_seed_1.vtp");
  EXPECT_THAT(text_of(runs / "drop_seed_1.vtp"), HasSubstr("type=\"PolyData\""));
}

TEST_F(Simulate, TrajectoriesAreSeriesOfStates) {
  EXPECT_EQ(run({"roll", "study.toml", "--out", "runs", "--trajectory-s", "0.1"}).exit_code, 0);
  EXPECT_THAT(text_of(path("runs/roll_seed_1/trajectory.pvd")), HasSubstr("frame_00002.vtp"));
}

TEST_F(Simulate, AllErrorsAreToldAtOnce) {
  const Finished finished = run({"spin", "none.toml", "--seed", "-1", "--repeats", "x", "--threads",
                                 "0", "--trajectory-s", "0", "--json", "no/x.json"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.out, IsEmpty());
  EXPECT_THAT(finished.err,
              AllOf(HasSubstr("simulate spin: "), HasSubstr("none.toml: there is no such file"),
                    HasSubstr("--seed -1"), HasSubstr("--repeats x"), HasSubstr("--threads 0"),
                    HasSubstr("--trajectory-s 0"), HasSubstr("--json no/x.json")));
  std::istringstream lines(finished.err);
  for (std::string line; std::getline(lines, line);) EXPECT_THAT(line, HasSubstr("Fix: "));
}

TEST_F(Simulate, ErrorsOfTheStudyHaveTheirPlace) {
  const Finished finished = run({"drop", "study.toml", "--set", "particle.poisson_ratio=0.5"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err,
              HasSubstr("setting (--set):1:24: particle.poisson_ratio = 0.5. Rule: "));
}

TEST_F(Simulate, ExperimentsThatAreNotDescribedAreRefused) {
  const Finished finished = run({"tilt", "study.toml"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("section [experiment.tilt] is missing"),
                                  HasSubstr("--set 'experiment.tilt={}'")));
}

TEST_F(Simulate, OpenCoefficientsAreRefusedWhereTheyMatter) {
  const Finished finished = run({"heap", "study.toml"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("--set contact.particle_particle.restitution=0.3"));
  EXPECT_EQ(run({"roll", "study.toml"}).exit_code, 0) << "one grain touches no other";
}

TEST_F(Simulate, ARunWithoutAReadingIsNoResult) {
  // Sliding friction that holds up to 89 degrees: the grains never slide.
  const Finished finished =
      run({"tilt", "study.toml", "--set", "experiment.tilt={rate_deg_s=10}", "--set",
           "contact.particle_wall.sliding_friction=90", "--out", "runs"});
  EXPECT_EQ(finished.exit_code, 3) << finished.err;
  EXPECT_THAT(finished.err, AllOf(HasSubstr("seed 1: "), HasSubstr("no result; 0 of 1")));
  EXPECT_FALSE(std::filesystem::exists(path("runs") / "result.json"));
}

TEST_F(Simulate, GrainsThatDoNotRiseAgainAreWarnedOf) {
  const Words words = {"drop",  "study.toml",
                       "--set", "experiment.drop.height_mm=0.01",
                       "--set", "contact.particle_wall.restitution=0.01"};
  EXPECT_THAT(run(words).err, HasSubstr("2 of 2 grains did not rebound"));
  EXPECT_EQ(timeless(words)["warnings"][0]["code"], "never_rose");
}

TEST_F(Simulate, RollsThatAreNoDistanceAreWarnedOf) {
  const Words stays = {"roll", "study.toml", "--set", "contact.particle_wall.rolling_friction=.5"};
  EXPECT_THAT(run(stays).err,
              HasSubstr("seed 1: the grain stayed on the incline in 1 release: it counts as 0"));
  const json roll = timeless(stays);
  EXPECT_EQ(roll["value"].get<double>(), 0);
  ASSERT_EQ(roll["warnings"].size(), 1U);
  EXPECT_EQ(roll["warnings"][0]["code"], "stayed_on_incline");
  EXPECT_TRUE(timeless({"roll", "study.toml"})["warnings"].empty());
}

TEST_F(Simulate, ElasticPlasticRollsThatHopAreWarnedOf) {
  const Words hops = {"roll",  "study.toml",
                      "--set", "contact.rolling_model=\"elastic_plastic\"",
                      "--set", "experiment.roll.release_mm=100",
                      "--set", "contact.particle_wall.restitution=.9"};
  const json roll = timeless(hops);
  EXPECT_GT(roll["repeats"][0]["readings"]["hop_mm"], .5);
  ASSERT_EQ(roll["warnings"].size(), 1U);
  EXPECT_EQ(roll["warnings"][0]["code"], "hops");
  const Words flat = with(hops, {"--set", "contact.particle_wall.restitution=.1"});
  EXPECT_TRUE(timeless(flat)["warnings"].empty());
  const Words constant = with(hops, {"--set", "contact.rolling_model=\"constant_torque\""});
  EXPECT_TRUE(timeless(constant)["warnings"].empty());
}

TEST_F(Simulate, SpheresThatMissTheShapeAreWarnedOf) {
  const Words stick = {"drop", "study.toml", "--set", "particle.size_mm=[20,6,6]"};
  EXPECT_THAT(run(stick).err, HasSubstr("1 sphere is not its shape"));
  EXPECT_EQ(timeless(stick)["warnings"][0]["code"], "shape");
}

TEST_F(Simulate, WhatWasNeverGivenIsCalledADefault) {
  const Finished finished = run({"heap", "study.toml", "--set", "particle.size_mm=[120,120,120]",
                                 "--set", "contact.particle_particle.restitution=.2"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("tube_diameter_mm = 100, the default"));
}

TEST_F(Simulate, HeapsWhoseAngleDependsOnTheWindowAreWarnedOf) {
  const std::string coefficients = "{restitution=0.2,sliding_friction=0.6,rolling_friction=0.3}";
  const Words rough = {"heap",    "study.toml",
                       "--set",   "particle.young_modulus_pa=1e6",
                       "--set",   "contact.particle_particle=" + coefficients,
                       "--set",   "contact.particle_wall.sliding_friction=0.8",
                       "--set",   "contact.particle_wall.rolling_friction=0.3",
                       "--set",   "experiment.heap.lift_speed_mm_s=100",
                       "--views", "0"};
  int warned = 0;
  for (const char* seed : {"17", "18", "19", "20", "21"}) {
    Words words = rough;
    words.insert(words.end(), {"--seed", seed, "--json", "-"});
    const json heap = json::parse(run(words).out);
    const json& readings = heap["repeats"][0]["readings"];
    // A layer, or a heap whose flank ends too steeply for such a narrow window.
    if (heap["value"].is_null() || readings["inner_window_deg"].is_null()) continue;
    const double apart =
        std::abs(heap["value"].get<double>() - readings["inner_window_deg"].get<double>());
    bool is_told = false;
    for (const json& warning : heap["warnings"]) {
      is_told = is_told || warning["code"] == "window";
    }
    EXPECT_EQ(is_told, apart > readings["between_views_deg"]) << heap;
    warned += is_told ? 1 : 0;
  }
  EXPECT_GT(warned, 0) << "forty grains: some heap is that low";
}

TEST_F(Simulate, AProtocolThatCannotBeRunIsToldOnce) {
  const Finished finished =
      run({"drop", "study.toml", "--repeats", "3", "--set", "simulation.timestep_s=0.5"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.err.find("0.5"), finished.err.rfind("0.5")) << finished.err;
}

TEST_F(Simulate, AnInterruptionLeavesNothingHalfWritten) {
  // Much longer than the first frame takes to appear.
  const pid_t program =
      start_repose(folder_, {"simulate", "heap", "study.toml", "--out", "runs", "--trajectory-s",
                             "0.001", "--set", "contact.particle_particle.restitution=0.2", "--set",
                             "particle.young_modulus_pa=1e9"});
  const auto runs = path("runs");
  int status = 0;
  while (!std::filesystem::exists(runs / "heap_seed_1" / "frame_00001.vtp")) {
    ASSERT_EQ(::waitpid(program, &status, WNOHANG), 0) << "ended by itself";
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_EQ(::kill(program, SIGINT), 0);
  ::waitpid(program, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(runs)) {
    const std::string name = entry.path().filename();
    EXPECT_THAT(name, Not(HasSubstr(".part")));
    EXPECT_NE(name, "result.json");
    EXPECT_NE(name, "heap_seed_1.vtp");
    if (entry.path().extension() == ".vtp") {
      EXPECT_THAT(text_of(entry.path()), HasSubstr("</VTKFile>"));
    }
  }
}

}  // namespace
}  // namespace repose::testing
