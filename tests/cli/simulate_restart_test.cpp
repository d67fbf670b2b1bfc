#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/cli/run_program.h"

namespace repose::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

/// A heap of a second's work.
constexpr const char* kStudy = R"([particle]
size_mm = [22.5, 18.2, 17.5]
spheres = 2
density_kg_m3 = 850
young_modulus_pa = 1e7
poisson_ratio = 0.38
[wall]
young_modulus_pa = 1e9
poisson_ratio = 0.3
[contact.particle_wall]
restitution = 0.5
sliding_friction = 0.4
rolling_friction = 0.1
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 50
grains = 2
[experiment.heap]
grains = 12
lift_speed_mm_s = 100
)";

class SimulateRestart : public ::testing::Test {
 protected:
  SimulateRestart() { folder_.write("study.toml", std::string(kStudy)); }

  Finished run(Words words) const {
    words.insert(words.begin(), "simulate");
    return run_repose(folder_, words);
  }

  /// Presses Ctrl-C when `frame` of the first repeat is there; the exit code.
  int run_until(const std::string& frame, Words words) const {
    words.insert(words.begin(), "simulate");
    const pid_t program = start_repose(folder_, words);
    int status = 0;
    while (!std::filesystem::exists(path("runs/heap_seed_1/" + frame))) {
      if (::waitpid(program, &status, WNOHANG) != 0) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ::kill(program, SIGINT);
    ::waitpid(program, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  /// The texts of all files in a folder but those that tell what a clock measured.
  std::map<std::string, std::string> texts_in(const std::string& name) const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(name))) {
      if (!entry.is_regular_file()) continue;
      std::string text = text_of(entry.path());
      if (entry.path().extension() == ".json") {
        json content = json::parse(text);
        content.erase("wall_s");
        if (content.contains("repeats")) {
          for (json& repeat : content["repeats"]) {
            for (const char* key : {"wall_s", "clump_steps_per_s", "state", "overlay"})
              repeat.erase(key);
          }
        }
        text = content.dump();
      }
      texts[entry.path().lexically_relative(path(name))] = text;
    }
    return texts;
  }
  TemporaryFolder folder_;
};

const Words kHeap = {"heap",           "study.toml", "--repeats", "2", "--threads", "1",
                     "--trajectory-s", "0.01",       "--views",   "1", "--out",     "runs"};

TEST_F(SimulateRestart, AnInterruptedHeapGoesOnToTheSameBytes) {
  // Some frames are of the filling, later ones of the lift.
  for (const char* frame : {"frame_00010.vtp", "frame_00030.vtp", "frame_00050.vtp"}) {
    ASSERT_EQ(run_until(frame, kHeap), 130);
    EXPECT_TRUE(std::filesystem::exists(path("runs/heap_seed_1.restart.vtp")));
    EXPECT_FALSE(std::filesystem::exists(path("runs/result.json")));
  }
  const Finished last = run(kHeap);
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("runs: goes on with an earlier run: of 2 repeats 0 finished "
                                  "already, 1 under way."));
  Words whole = kHeap;
  whole.back() = "whole";
  ASSERT_EQ(run(whole).exit_code, 0);
  const auto runs = texts_in("runs");
  EXPECT_TRUE(runs == texts_in("whole")) << "compared as a whole: the files are large";
  EXPECT_FALSE(runs.contains("heap_seed_1.restart.vtp")) << "done with";
}

TEST_F(SimulateRestart, FinishedRepeatsAreNotSimulatedAgain) {
  const Words one = {"drop", "study.toml", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  const std::string first = text_of(path("runs/drop_seed_1.json"));
  Words three = one;
  three.insert(three.end(), {"--repeats", "3"});
  const Finished more = run(three);
  EXPECT_THAT(more.err, HasSubstr("of 3 repeats 1 finished already"));
  EXPECT_EQ(text_of(path("runs/drop_seed_1.json")), first) << "the time it took is the first's";
  three[3] = "whole";
  ASSERT_EQ(run(three).exit_code, 0);
  EXPECT_EQ(texts_in("runs"), texts_in("whole"));
}

TEST_F(SimulateRestart, AnotherRunInTheSameFolderIsRefused) {
  const Words one = {"drop", "study.toml", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  const auto before = texts_in("runs");
  const std::map<std::string, Words> others = {
      {"its experiment is \"drop\", not \"heap\"", {"heap", "study.toml", "--out", "runs"}},
      {"the study, its scan or the --set settings were other ones",
       {"drop", "study.toml", "--out", "runs", "--set", "wall.poisson_ratio=0.31"}},
      {"its trajectory_s is null, not 0.5",
       {"drop", "study.toml", "--out", "runs", "--trajectory-s", "0.5"}}};
  for (const auto& [what, words] : others) {
    const Finished refused = run(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--out runs: it holds another run"), HasSubstr(what),
                                   HasSubstr("Fix: another folder")));
  }
  EXPECT_EQ(texts_in("runs"), before);
}

TEST_F(SimulateRestart, FilesThatWereChangedAreRefused) {
  const Words one = {"drop", "study.toml", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  for (const char* text : {"", "[]", "{\"identity\": 1}", "{\"identity\": {\"seed\": 2}}"}) {
    folder_.write("runs/drop_seed_1.json", std::string(text));
    const Finished refused = run(one);
    EXPECT_EQ(refused.exit_code, 2) << text;
    EXPECT_THAT(refused.err,
                AllOf(HasSubstr("drop_seed_1.json: it "), HasSubstr("Fix: delete it")));
  }
  std::filesystem::remove(path("runs/drop_seed_1.json"));
  EXPECT_EQ(run(one).exit_code, 0);
  folder_.write("runs/run.json", std::string("{"));
  EXPECT_THAT(run(one).err, HasSubstr("run.json was changed"));
}

TEST_F(SimulateRestart, ARestartPointOfAnotherSeedIsRefused) {
  Words words = kHeap;
  ASSERT_EQ(run_until("frame_00010.vtp", words), 130);
  std::filesystem::rename(path("runs/heap_seed_1.restart.vtp"),
                          path("runs/heap_seed_2.restart.vtp"));
  words.insert(words.end(), {"--seed", "2"});
  const Finished refused = run(words);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("it belongs to another run"));
  folder_.write("runs/heap_seed_2.restart.vtp", std::string("<VTKFile"));
  EXPECT_THAT(run(words).err, HasSubstr("it is cut short or was changed. Fix: delete it"));
}

}  // namespace
}  // namespace repose::testing
