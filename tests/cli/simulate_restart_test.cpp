#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/cli/command_test.h"
#include "tests/support/soft_study.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A heap that takes a second, so small that it is a layer and has no angle.
const std::string kStoppedStudy = kSoftNuts + R"([contact.particle_wall]
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

constexpr int kNoAngle = 3;

class SimulateRestart : public CommandTest {
 protected:
  SimulateRestart() : CommandTest({"simulate"}) { folder_.write("study.toml", kStoppedStudy); }

  /// Sends SIGINT (Ctrl-C) once `frame` of a repeat exists; returns the exit code.
  int run_until(const std::string& frame, Words words, int seed = 1) const {
    const pid_t program = start_repose(folder_, with_command(std::move(words)));
    int status = 0;
    while (!std::filesystem::exists(path("runs/heap_seed_" + std::to_string(seed) + "/" + frame))) {
      if (::waitpid(program, &status, WNOHANG) != 0) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ::kill(program, SIGINT);
    ::waitpid(program, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Files of the store whose names end in `ending`.
  std::vector<std::filesystem::path> stored(const std::string& ending) const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(path("runs/runs"))) {
      if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
    }
    return files;
  }

  /// Texts of all files in a folder, without timings.
  std::map<std::string, std::string> texts_in(const std::string& name) const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(name))) {
      if (!entry.is_regular_file()) continue;
      std::string text = text_of(entry.path());
      if (entry.path().extension() == ".json") {
        json content = json::parse(text);
        for (const char* key : {"wall_s", "fingerprint"}) content.erase(key);
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
};

const Words kHeap = {"heap",           "study.toml", "--repeats", "2", "--threads", "1",
                     "--trajectory-s", "0.05",       "--views",   "1", "--out",     "runs"};

TEST_F(SimulateRestart, AnInterruptedHeapGoesOnToTheSameBytes) {
  // The first frames are of the filling, later ones of the lift.
  for (const char* frame : {"frame_00002.vtp", "frame_00006.vtp", "frame_00010.vtp"}) {
    ASSERT_EQ(run_until(frame, kHeap), 130);
    EXPECT_THAT(stored(".restart.vtp"), SizeIs(1));
    EXPECT_FALSE(std::filesystem::exists(path("runs/result.json")));
  }
  const Finished last = run(kHeap);
  EXPECT_EQ(last.exit_code, kNoAngle) << last.err;
  EXPECT_THAT(last.err, HasSubstr("runs: resuming an earlier run: of 2 repeats 0 "
                                  "finished, 1 in progress."));
  Words whole = kHeap;
  whole.back() = "whole";
  ASSERT_EQ(run(whole).exit_code, kNoAngle);
  const auto runs = texts_in("runs");
  EXPECT_TRUE(runs == texts_in("whole")) << "compared as a whole: the files are large";
  EXPECT_THAT(stored(".restart.vtp"), IsEmpty()) << "done with";
}

TEST_F(SimulateRestart, FinishedRepeatsAreNotSimulatedAgain) {
  const Words one = {"drop", "study.toml", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  ASSERT_THAT(stored(".json"), SizeIs(1));
  const std::filesystem::path file = stored(".json").front();
  const std::string first = text_of(file);
  Words three = one;
  three.insert(three.end(), {"--repeats", "3"});
  const Finished more = run(three);
  EXPECT_THAT(more.err, HasSubstr("of 3 repeats 1 finished"));
  EXPECT_EQ(text_of(file), first) << "the time it took is the first's";
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
      {"the study, its scan or the --set settings were different",
       {"drop", "study.toml", "--out", "runs", "--set", "wall.poisson_ratio=0.31"}},
      {"its trajectory_s is null, not 0.5",
       {"drop", "study.toml", "--out", "runs", "--trajectory-s", "0.5"}}};
  for (const auto& [what, words] : others) {
    const Finished refused = run(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--out runs: contains a different run"),
                                   HasSubstr(what), HasSubstr("Fix: choose another folder")));
  }
  EXPECT_EQ(texts_in("runs"), before);
}

TEST_F(SimulateRestart, ARunThatLeftNothingDoesNotBlockItsFolder) {
  const Words refused = {"drop", "study.toml", "--out",
                         "runs", "--set",      "simulation.timestep_s=.5"};
  ASSERT_EQ(run(refused).exit_code, 2);
  // The grain slides at once, which is stored as the outcome.
  const Words unread = {"tilt", "study.toml", "--out",
                        "runs", "--set",      "experiment.tilt.start_deg=80"};
  const Finished failed = run(unread);
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  const Words one = {"drop", "study.toml", "--out", "runs"};
  EXPECT_EQ(run(one).exit_code, 0);
  EXPECT_THAT(run(unread).err, HasSubstr("contains a different run")) << "there is a result now";
}

TEST_F(SimulateRestart, RunsWhoseFilesWereDamagedAreSimulatedAgain) {
  const Words one = {"drop", "study.toml", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  const auto whole = texts_in("runs");
  const std::string file = stored(".json").front().lexically_relative(folder_.path());
  for (const char* text : {"", "[]", "{\"simulated\": 1}", "{\"simulated\": {\"seed\": 2}}"}) {
    folder_.write(file, std::string(text));
    ASSERT_EQ(run(one).exit_code, 0) << text;
    EXPECT_EQ(texts_in("runs"), whole) << text;
  }
  std::filesystem::remove(stored(".vtp").front());
  ASSERT_EQ(run(one).exit_code, 0);
  EXPECT_EQ(texts_in("runs"), whole);
  folder_.write("runs/run.json", std::string("{"));
  EXPECT_THAT(run(one).err, HasSubstr("run.json was changed"));
}

TEST_F(SimulateRestart, ARestartPointOfAnotherSeedIsRefused) {
  const Words words = kHeap;
  ASSERT_EQ(run_until("frame_00002.vtp", words), 130);
  const std::filesystem::path first = stored(".restart.vtp").front();
  // Seed 2 is interrupted too, and its restart point replaced by that of seed 1.
  Words second = words;
  second[3] = "1";
  second.insert(second.end(), {"--seed", "2"});
  ASSERT_EQ(run_until("frame_00002.vtp", second, 2), 130);
  std::filesystem::path other;
  for (const auto& file : stored(".restart.vtp")) {
    if (file != first) other = file;
  }
  ASSERT_FALSE(other.empty());
  std::filesystem::copy_file(first, other, std::filesystem::copy_options::overwrite_existing);
  const Finished refused = run(second);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("it belongs to another run"));
  folder_.write(other.lexically_relative(folder_.path()), std::string("<VTKFile"));
  EXPECT_THAT(run(second).err, HasSubstr("earlier version. Fix: delete it"));
}

TEST_F(SimulateRestart, ARestartPointThatWasChangedIsRefused) {
  ASSERT_EQ(run_until("frame_00002.vtp", kHeap), 130);
  const std::filesystem::path file = stored(".restart.vtp").front();
  std::string state = text_of(file);
  char& letter = state[state.find("Name=\"velocity\"") + 100];
  letter = letter == 'A' ? 'B' : 'A';
  folder_.write(file.lexically_relative(folder_.path()), state);
  const Finished refused = run(kHeap);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr(file.filename().string()), HasSubstr("was changed"),
                                 HasSubstr("Fix: delete it")));
}

TEST_F(SimulateRestart, RunsAreFoundAgainInAnotherStudy) {
  Words one = {"drop", "study.toml", "--repeats", "2", "--out", "runs"};
  ASSERT_EQ(run(one).exit_code, 0);
  const std::size_t before = stored(".json").size();
  ASSERT_EQ(before, 2U);
  // Another file, hence another study, but the same drops.
  folder_.write("other.toml", kStoppedStudy + "[simulation]\nseed = 1\n");
  one[1] = "other.toml";
  std::filesystem::remove(path("runs/run.json"));
  const Finished again = run(one);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("of 2 repeats 2 finished"));
  EXPECT_EQ(stored(".json").size(), before);
}

}  // namespace
}  // namespace repose::testing
