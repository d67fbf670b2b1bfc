#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

TEST(Usage, TheProgramAlonePrintsItsHelp) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("measure"), HasSubstr("Examples:")));
  EXPECT_THAT(run.err, IsEmpty());
}

TEST(Usage, HelpDescribesTheMethodsAndFitsATerminal) {
  const TemporaryFolder folder;
  for (const auto& words : {std::vector<std::string>{"--help"},
                            {"measure", "--help"},
                            {"compare", "--help"},
                            {"shape", "--help"},
                            {"simulate", "--help"},
                            {"plan", "--help"},
                            {"bench", "--help"},
                            {"design", "--help"},
                            {"regress", "--help"},
                            {"verify", "--help"}}) {
    const Finished run = run_repose(folder, words);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_LE(longest_line(run.out), 80U) << words.front();
  }
  EXPECT_THAT(run_repose(folder, {"measure", "--help"}).out,
              AllOf(HasSubstr("auto "), HasSubstr("paper "), HasSubstr("Otsu"),
                    HasSubstr("--definitions"), HasSubstr("--exclude")));
}

TEST(Usage, VersionIsOneLine) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out,
              MatchesRegex("repose [0-9]+\\.[0-9]+\\.[0-9]+(\\+([0-9]+\\.)?g[0-9a-f]+)?\n"));
}

TEST(Usage, MistypedWordsAreGuessed) {
  const TemporaryFolder folder;
  const Finished command = run_repose(folder, {"mesure", "heap.jpg"});
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_THAT(command.err, AllOf(HasSubstr("mesure"), HasSubstr("Did you mean measure?")));
  EXPECT_THAT(command.out, IsEmpty());

  const Finished option = run_repose(folder, {"measure", "heap.jpg", "--overlya", "x"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, AllOf(HasSubstr("--overlya"), HasSubstr("Did you mean --overlay?")));
}

TEST(Usage, UnguessableWordsHaveNoGuess) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {"measure", "heap.jpg", "--frobnicate"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("--frobnicate"), HasSubstr("repose measure --help")));
  EXPECT_EQ(run.err.find("Did you mean"), std::string::npos);
}

TEST(Usage, SimulatingNothingIsSaid) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {"simulate", "heap"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("study file"), HasSubstr("Fix: ")));
}

TEST(Usage, NoPictureNamedIsSaid) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {"measure"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("no picture given"), HasSubstr("Fix: ")));
}

TEST(Usage, AMissingValueIsSaid) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, {"measure", "heap.jpg", "--json"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("--json"), HasSubstr("Fix: ")));
}

TEST(Usage, AllErrorsAreSaidAtOnce) {
  const TemporaryFolder folder;
  const Finished run =
      run_repose(folder, {"measure", "heap.jpg", "--method", "papr", "--window", "0.8,0.2",
                          "--exclude", "1,2,3", "--exclude", "-1,0,5,5", "--exclude", "0,0,0,5",
                          "--pitch-deg", "45", "--threads", "0", "--json", "no/all.json"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, IsEmpty());
  for (const char* error :
       {"--method papr", "window (--window) = 0.8,0.2", "--exclude 1,2,3",
        "excluded box (--exclude) = -1,0,5,5", "excluded box (--exclude) = 0,0,0,5",
        "camera pitch (--pitch-deg) = 45", "--threads 0", "--json no/all.json"}) {
    EXPECT_THAT(run.err, HasSubstr(error));
  }
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 8);
}

TEST(Usage, AProgramThatRunsNoCasesIsRefused) {
  const TemporaryFolder folder;
  for (const char* program : {"edem", "repose"}) {
    const Finished run =
        run_repose(folder, {"verify", "--engine", program, "--json", "cases.json"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, AllOf(HasSubstr(program), HasSubstr("--engine liggghts")));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "cases.json"));
  }
}

TEST(Usage, NonsenseWindowsAreRefused) {
  const TemporaryFolder folder;
  for (const char* window : {"0.2", "a,b", "0.2,0.8,0.9", "nan,0.8", "0.2,inf", "-0.1,0.8",
                             "0.2,1.2", "0.5,0.5", "0.5,0.51", "0.2;0.8", "0.2,0.8x"}) {
    const Finished run = run_repose(folder, {"measure", "heap.jpg", "--window", window});
    EXPECT_EQ(run.exit_code, 2) << window;
    EXPECT_THAT(run.err, AllOf(HasSubstr("window"), HasSubstr("Fix: ")));
  }
}

}  // namespace
}  // namespace repose::testing
