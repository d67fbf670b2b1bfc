#include <algorithm>
#include <string>

#include <gmock/gmock.h>

#include "cli/program.h"
#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

class Completion : public ::testing::Test {
 protected:
  /// Bash's completions for these words, the last of which is incomplete.
  std::vector<std::string> in_bash(const std::string& words) const {
    const Finished done =
        run_program("bash", folder_,
                    {"-c", "source ./repose.bash; COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _repose; "
                               "printf '%s\\n' \"${COMPREPLY[@]}\""});
    EXPECT_EQ(done.err, "");
    return lines_of(done.out);
  }

  void SetUp() override {
    folder_.write("repose.bash", run_repose(folder_, {"completion", "bash"}).out);
    folder_.write("my heap.jpg", "");
  }

  TemporaryFolder folder_;
};

TEST_F(Completion, BashKnowsCommandsOptionsAndTheirValues) {
  EXPECT_THAT(in_bash("repose mea"), ElementsAre("measure"));
  EXPECT_THAT(in_bash("repose ''"), IsSupersetOf({"measure", "verify", "completion", "--version"}));
  EXPECT_THAT(in_bash("repose measure --over"), ElementsAre("--overlay"));
  EXPECT_THAT(in_bash("repose calibrate --over"), IsEmpty());
  EXPECT_THAT(in_bash("repose measure --method ''"), ElementsAre("auto", "paper"));
  EXPECT_THAT(in_bash("repose simulate t"), ElementsAre("tilt", "tilt_on_grains"));
  EXPECT_THAT(in_bash("repose measure --window ''"), IsEmpty());
  EXPECT_THAT(in_bash("repose new x.toml --grains so"), ElementsAre("soybean"));
  EXPECT_THAT(in_bash("repose new x.toml --plate a"), ElementsAre("acrylic", "aluminium"));
}

TEST_F(Completion, BashOffersFilesWhereFilesAreMeant) {
  EXPECT_THAT(in_bash("repose measure my"), ElementsAre("my heap.jpg"));
  EXPECT_THAT(in_bash("repose measure x.jpg --json my"), ElementsAre("my heap.jpg"));
  EXPECT_THAT(in_bash("repose verify my"), IsEmpty());
}

TEST_F(Completion, ZshIsToldEveryOptionOfACommand) {
  folder_.write("_repose", run_repose(folder_, {"completion", "zsh"}).out);
  // What the script passes to zsh's own functions, which need a keyboard.
  const Finished done =
      run_program("zsh", folder_,
                  {"-f", "-c",
                   "compdef() {}; _arguments() { print -rl -- \"$@\" }; source ./_repose; "
                   "words=(repose measure ''); CURRENT=3; _repose"});
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(lines_of(done.out),
              AllOf(Contains("--method[Method of measuring (auto)]:auto|paper:(auto paper)"),
                    Contains("*--keep[Point on the heap; repeatable]:X,Y: "),
                    Contains("--json[Full results, for programs]:FILE|-:_files"),
                    Contains("--pitch-deg[Camera's downward pitch (unknown)]:DEGREES: "),
                    Contains("*:PICTURE|FOLDER ...:_files")));
}

TEST_F(Completion, AnUnknownShellIsRefused) {
  const Finished done = run_repose(folder_, {"completion", "fish"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("fish"), HasSubstr("Fix: ")));
  EXPECT_THAT(done.out, IsEmpty());
}

TEST(Help, HasNoLineWiderThanATerminal) {
  const auto columns = [](const std::string& line) {
    return std::ranges::count_if(line, [](char byte) { return (byte & 0xC0) != 0x80; });
  };
  for (const cli::Command& command : cli::all_commands()) {
    for (const std::string& line : lines_of(command.notes)) EXPECT_LE(columns(line), 85) << line;
  }
}

TEST(Manual, HasAPageForEveryCommandWithAllItsOptions) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_repose(folder, {"manual", "new/man1"}).exit_code, 0);
  EXPECT_THAT(text_of(folder.path() / "new/man1/repose.1"), HasSubstr("repose\\-calibrate"));
  for (const auto& page : std::filesystem::directory_iterator(folder.path() / "new/man1")) {
    const Finished shown =
        run_program("groff", folder, {"-man", "-Tutf8", "-ww", "-P-cbou", page.path().string()});
    EXPECT_EQ(shown.exit_code, 0);
    EXPECT_EQ(shown.err, "") << page.path();
    const std::string name = page.path().stem();
    if (name == "repose") continue;
    const Finished help =
        run_repose(folder, {name.substr(std::string("repose-").size()), "--help"});
    for (const std::string& line : lines_of(help.out)) {
      if (!line.starts_with("  --")) continue;
      const std::string option = line.substr(2, line.find(' ', 2) - 2);
      EXPECT_THAT(shown.out, HasSubstr(option)) << name;
    }
    EXPECT_THAT(shown.out, Not(HasSubstr("\\f")));
  }
}

TEST(Manual, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const Finished done = run_repose(folder, {"manual", "file/man1"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("file/man1"), HasSubstr("Fix: ")));
}

}  // namespace
}  // namespace repose::testing
