#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <sys/wait.h>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// What commands leave in folders, and what they do with existing files.
class Folders : public CommandTest {
 protected:
  Folders() : CommandTest({}) { folder_.write("study.toml", calibrate::test::kSphereStudy); }

  void write_users(const std::string& name) const {
    std::filesystem::create_directories(path(name).parent_path());
    folder_.write(name, std::string("the user's"));
  }
  /// Files of a folder's store whose names end in `ending`.
  std::vector<std::filesystem::path> stored(const std::string& name,
                                            const std::string& ending) const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(path(name + "/runs"))) {
      if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  std::vector<std::string> names_in(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(name))) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
  /// The study with a tilt that takes minutes.
  void write_long_study(const std::string& name) const {
    std::string study = calibrate::test::kSphereStudy;
    study.replace(study.find("rate_deg_s = 10"), 15, "rate_deg_s = 0.01");
    study.replace(study.find("density_kg_m3 = 1000"), 20, "density_kg_m3 = 1500");
    folder_.write(name, study);
  }
  /// Waits for a minute at most, since the machine may be busy.
  void wait_until_there(const std::string& name) const {
    for (int k = 0; k < 12'000 && !exists(name); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  /// Kills a program when a file has appeared.
  void interrupt_when_there(pid_t program, const std::string& name) const {
    wait_until_there(name);
    ::kill(program, SIGKILL);
    int status = 0;
    ::waitpid(program, &status, 0);
  }
};

constexpr const char* kWall =
    "contact.particle_wall={restitution=0.5,sliding_friction=0.4,rolling_friction=0.01}";
const Words kDrop = {"simulate", "drop", "study.toml", "--set", kWall};

TEST_F(Folders, CalibrateDoesNotTakeOverAFolderOfTheUsers) {
  for (const char* name : {"own/study.toml", "own/clump.json", "own/study.json", "own/result.json",
                           "own/heap.vtp", "own/other.txt"}) {
    write_users(name);
  }
  const Finished refused = run({"calibrate", "study.toml", "--out", "own"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--out own: not a folder of repose calibrate"),
                                 HasSubstr("clump.json, study.json, result.json, heap.vtp"),
                                 HasSubstr("Fix: ")));
  for (const std::string& name : names_in("own")) EXPECT_EQ(text("own/" + name), "the user's");
}

TEST_F(Folders, CalibrateWorksBesideTheStudyAndAmongOtherFiles) {
  std::filesystem::create_directory(path("mine"));
  std::filesystem::copy(path("study.toml"), path("mine/study.toml"));
  write_users("mine/notes.txt");
  const Words words = {"calibrate", "mine/study.toml", "--out", "mine"};
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(text("mine/notes.txt"), "the user's");
  const Finished again = run(words);
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(Folders, SimulateDoesNotTakeOverAFolderOfTheUsers) {
  write_users("own/result.json");
  write_users("own/drop_seed_1.vtp");
  const Finished refused = run(with(kDrop, {"--out", "own"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--out own: not a folder of repose simulate"),
                                 HasSubstr("result.json, drop_seed_1.vtp")));
  EXPECT_THAT(names_in("own"), UnorderedElementsAre("result.json", "drop_seed_1.vtp"));
  EXPECT_EQ(text("own/result.json"), "the user's");
}

TEST_F(Folders, NoOutputReplacesWhatIsRead) {
  const std::string study = text("study.toml");
  ASSERT_EQ(
      run({"shape", "--size-mm", "20,18,16", "--spheres", "2", "--out", "ball.json"}).exit_code, 0);
  const std::string ball = text("ball.json");
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "done"}).exit_code, 0);
  const std::string clump =
      "particle={clump=\"ball.json\",density_kg_m3=1000,"
      "young_modulus_pa=1e6,poisson_ratio=0.3}";
  for (const Words& words :
       {Words{"calibrate", "study.toml", "--out", "new", "--json", "study.toml"},
        {"calibrate", "study.toml", "--out", "new", "--set", clump, "--json", "./ball.json"},
        {"calibrate", "study.toml", "--out", "done", "--json", "done/study.json"},
        with(kDrop, {"--json", "study.toml"}),
        with(kDrop, {"--set", clump, "--json", "ball.json"}),
        with(kDrop, {"--out", "done", "--json", "done/drop.json"}),
        {"export", "done", "--to", "yade", "--json", "done/result.json"},
        {"report", "done", "--out", "done/result.json"},
        {"report", "done", "--out", "done/clump.json"}}) {
    const Finished refused = run(words);
    EXPECT_EQ(refused.exit_code, 2) << words.back();
    EXPECT_THAT(refused.err, HasSubstr("Fix: ")) << words.back();
  }
  EXPECT_EQ(text("study.toml"), study);
  EXPECT_EQ(text("ball.json"), ball);
  EXPECT_FALSE(exists("new"));
  EXPECT_EQ(run({"export", "done", "--to", "yade"}).exit_code, 0) << "all of it is as it was";
}

TEST_F(Folders, AStudyThatWasChangedAndInterruptedHasNoResult) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  const std::string first = text("d/result.json");
  const std::string runs = text("d/study.json");
  write_long_study("study.toml");
  const pid_t program = start_repose(folder_, {"calibrate", "study.toml", "--out", "d"});
  for (int k = 0; k < 12'000 && text("d/study.json") == runs; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::kill(program, SIGKILL);
  int status = 0;
  ::waitpid(program, &status, 0);
  const Finished refused = run({"export", "d", "--to", "yade"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("the study is unfinished"));
  std::vector<std::string> kept;
  for (const std::string& name : names_in("d")) {
    if (name.starts_with("result_quick_")) kept.push_back(text("d/" + name));
  }
  EXPECT_EQ(kept, std::vector{first});
  // As if left by an earlier version.
  folder_.write("d/result.json", first);
  const Finished mixed = run({"export", "d", "--to", "yade"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("result.json does not belong to the study in study.json"));
  EXPECT_FALSE(exists("d/export"));
}

TEST_F(Folders, ACopyOfAStudyThatWasChangedIsNotExported) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  write_long_study("d/study.toml");
  const Finished refused = run({"export", "d", "--to", "yade"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("d/study.toml: does not belong to study.json"));
}

TEST_F(Folders, RunsThatWereChangedAreNamedAndSimulatedAnew) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  const std::string result = text("d/result.json");
  const auto runs = stored("d", ".json");
  json changed = json::parse(text_of(runs[0]));
  changed["readings"] = json::object();
  folder_.write("d/runs/" + runs[0].filename().string(), changed.dump());
  changed = json::parse(text_of(runs[1]));
  changed["value"] = 1e200;
  folder_.write("d/runs/" + runs[1].filename().string(), changed.dump());
  std::string digit = text_of(runs[2]);
  char& first = digit[digit.find("\"value\": ") + 9];
  first = first == '1' ? '2' : '1';
  folder_.write("d/runs/" + runs[2].filename().string(), digit);
  changed = json::parse(text_of(runs[3]));
  changed.erase("fingerprint");
  folder_.write("d/runs/" + runs[3].filename().string(), changed.dump());
  std::filesystem::remove(path("d/result.json"));
  const Finished again = run({"calibrate", "study.toml", "--out", "d"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (int k = 0; k < 4; ++k) EXPECT_THAT(again.err, HasSubstr(runs[k].filename().string()));
  EXPECT_THAT(again.err, AllOf(HasSubstr("simulated again"), HasSubstr("earlier version")));
  EXPECT_EQ(text("d/result.json"), result);
}

TEST_F(Folders, StatesThatWereChangedAreNamedAndSimulatedAnew) {
  const Words words = with(kDrop, {"--out", "runs"});
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string state = text("runs/drop_seed_1.vtp");
  const auto kept = stored("runs", ".vtp");
  std::string changed = text_of(kept[0]);
  const std::size_t at = changed.find("DataArray") + 200;
  changed[at] = changed[at] == 'A' ? 'B' : 'A';
  folder_.write("runs/runs/" + kept[0].filename().string(), changed);
  const Finished again = run(words);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err,
              AllOf(HasSubstr(kept[0].filename().string()), HasSubstr("simulated again")));
  EXPECT_EQ(text("runs/drop_seed_1.vtp"), state);
}

TEST_F(Folders, TwoAtOnceInOneFolderAreToldApart) {
  write_long_study("long.toml");
  const pid_t first = start_repose(folder_, {"calibrate", "long.toml", "--out", "d"});
  wait_until_there("d/study.json");
  for (const Words& words :
       {Words{"calibrate", "study.toml", "--out", "d"}, with(kDrop, {"--out", "d"})}) {
    const Finished second = run(words);
    EXPECT_EQ(second.exit_code, 2) << words.front();
    EXPECT_THAT(second.err, AllOf(HasSubstr("process " + std::to_string(first)),
                                  HasSubstr("is using it"), HasSubstr("Fix: ")));
  }
  EXPECT_EQ(run({"report", "d"}).exit_code, 0) << "looking at it is no work in it";
  interrupt_when_there(first, "d");
  EXPECT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0) << "a kill leaves no lock";
}

TEST_F(Folders, SignalsEndAStudyInGoodOrder) {
  write_long_study("long.toml");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove_all(path("d"));
    const pid_t program = start_repose(folder_, {"calibrate", "long.toml", "--out", "d"});
    wait_until_there("d/study.json");  // signals are handled before this is written,
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // and by now it is simulating
    ::kill(program, signal);
    int status = 0;
    ::waitpid(program, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << signal;
    EXPECT_EQ(WEXITSTATUS(status), 130) << signal;
    EXPECT_FALSE(exists("d/result.json"));
  }
}

/// Interrupts a command after some milliseconds, with a delay adjusted until it ends with exit code
/// 130.
/// @param made  the file or folder that it would write
void expect_good_ends(const TemporaryFolder& folder, const Words& words,
                      const std::filesystem::path& made) {
  constexpr int kStep_ms = 3, kTries = 300;
  int delay_ms = 0;
  for (int k = 0; k < kTries; ++k) {
    std::filesystem::remove_all(made);
    const pid_t program = start_repose(folder, words);
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    ::kill(program, SIGTERM);
    int status = 0;
    ::waitpid(program, &status, 0);
    if (!WIFEXITED(status)) {  // it had not started properly
      delay_ms += kStep_ms;
      continue;
    }
    if (WEXITSTATUS(status) == 130) {
      EXPECT_FALSE(std::filesystem::exists(made));
      return;
    }
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_TRUE(std::filesystem::exists(made));
    delay_ms = std::max(0, delay_ms - 2 * kStep_ms);
  }
  ADD_FAILURE() << words.front() << " never ended with exit code 130";
}

TEST_F(Folders, SignalsEndReportsInGoodOrder) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  expect_good_ends(folder_, {"report", "d"}, path("d/report.html"));
  expect_good_ends(folder_, {"export", "d", "--to", "yade"}, path("d/export/yade"));
}

TEST_F(Folders, ARunFileThatIsAFolderIsNamed) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  const std::filesystem::path run_file = stored("d", ".json").front();
  std::filesystem::remove(run_file);
  std::filesystem::create_directory(run_file);
  std::filesystem::remove(path("d/result.json"));
  const Finished refused = run({"calibrate", "study.toml", "--out", "d"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr(run_file.filename().string() + ": is a folder"),
                    HasSubstr("Fix: move it away"), Not(HasSubstr("name a file inside it"))));
}

TEST_F(Folders, AStudyNeedsFewOpenFilesAndLittleMemory) {
  std::string limits = "ulimit -n 256";
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limits += " -v 1048576";  // KiB
#endif
  folder_.write("line.sh", limits + "; exec '" + program().string() +
                               "' calibrate study.toml --out d --jobs 2\n");
  const Finished done = run_program("bash", folder_, {"line.sh"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
}

TEST_F(Folders, ClocksDoNotMatter) {
  const Words words = {"calibrate", "study.toml", "--out", "d"};
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string result = text("d/result.json");
  std::filesystem::remove(path("d/result.json"));
  int years = -30;
  for (const auto& file : stored("d", ".json")) {
    const auto now = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(file, now + std::chrono::hours(24 * 365 * years++));
  }
  const Finished again = run(words);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, Not(HasSubstr("round 1")));
  EXPECT_EQ(text("d/result.json"), result);
}

TEST_F(Folders, ADiskWithoutInodesAndThenWithLosesNothing) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "whole"}).exit_code, 0);
  const std::string repose = "'" + program().string() + "' calibrate study.toml --out disk/d\n";
  folder_.write("disk.sh",
                "mkdir disk && mount -t tmpfs -o size=8m,nr_inodes=14 none disk || exit 77\n" +
                    repose + "echo $? >first\nmount -o remount,nr_inodes=1000 disk\n" + repose +
                    "echo $? >second\ncp disk/d/result.json .\n");
  const Finished done = run_program("unshare", folder_, {"-m", "sh", "disk.sh"});
  if (!exists("first")) GTEST_SKIP() << "nothing can be mounted here";
  EXPECT_EQ(text("first"), "2\n");
  EXPECT_EQ(text("second"), "0\n");
  EXPECT_THAT(done.err, AllOf(HasSubstr("No space left on device"), HasSubstr("Fix: "),
                              HasSubstr("simulations were taken from")));
  EXPECT_EQ(text("result.json"), text("whole/result.json"));
}

TEST_F(Folders, AReadOnlyDiskIsSaidBeforeAnyWork) {
  folder_.write("disk.sh", "mkdir disk && mount -t tmpfs -o ro none disk || exit 77\n'" +
                               program().string() +
                               "' calibrate study.toml --out disk/d --json disk/x.json\n"
                               "echo $? >first\n");
  const Finished done = run_program("unshare", folder_, {"-m", "sh", "disk.sh"});
  if (!exists("first")) GTEST_SKIP() << "nothing can be mounted here";
  EXPECT_EQ(text("first"), "2\n");
  EXPECT_THAT(done.err, AllOf(HasSubstr("Read-only file system"), HasSubstr("Fix: ")));
}

TEST_F(Folders, AnExportLeavesFilesOfTheUsersAndTakesItsOwnAway) {
  ASSERT_EQ(run({"calibrate", "study.toml", "--out", "d"}).exit_code, 0);
  write_users("own/README.txt");
  const Finished refused = run({"export", "d", "--to", "edem", "--out", "own"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("would be lost: README.txt"), HasSubstr("Fix: ")));
  EXPECT_EQ(text("own/README.txt"), "the user's");
  write_users("decks/notes.txt");
  ASSERT_EQ(run({"export", "d", "--to", "yade", "--out", "decks"}).exit_code, 0);
  ASSERT_EQ(run({"export", "d", "--to", "edem", "--out", "decks"}).exit_code, 0);
  EXPECT_THAT(names_in("decks"),
              UnorderedElementsAre("notes.txt", "values.txt", "values.csv", "spheres.txt",
                                   "further_runs.toml", "README.txt", ".repose-files"));
}

}  // namespace
}  // namespace repose::testing
