#include "base/child_process.h"

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace repose::base {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ChildProcessTest : public ::testing::Test {
 protected:
  ProcessStart shell(const std::string& script) const {
    return {.words = {"sh", "-c", script}, .folder = folder_.path(), .output = output_};
  }

  static ProcessEnd wait_for(ChildProcess& process) {
    std::optional<ProcessEnd> end;
    while (!(end = process.end())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return *end;
  }

  /// Of a whole run.
  ProcessEnd end_of(const std::string& script) const {
    ChildProcess process(shell(script));
    return wait_for(process);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path output_ = folder_.path() / "output.txt";
};

TEST_F(ChildProcessTest, TellsHowItEnded) {
  EXPECT_TRUE(end_of("exit 0").is_good());
  EXPECT_EQ(end_of("exit 3").text(), "exit code 3");
  EXPECT_THAT(end_of("kill -SEGV $$").text(), HasSubstr("signal 11"));
  EXPECT_THAT(end_of("sh -c 'kill -KILL $$'; exit $?").text(), HasSubstr("signal 9"));
  EXPECT_EQ(end_of("no_such_program").text(), "exit code 127");
}

TEST_F(ChildProcessTest, WorksInItsFolderWithoutInput) {
  EXPECT_TRUE(end_of("cat; pwd; echo wrong >&2").is_good());
  EXPECT_THAT(last_lines(output_, 5),
              ElementsAre(std::filesystem::canonical(folder_.path()).string(), "wrong"));
}

TEST_F(ChildProcessTest, LastLinesAreFewAndFitATerminal) {
  end_of(
      "i=0; while [ $i -lt 20000 ]; do echo line $i of what takes a megabyte and more xxxxxxxx; "
      "i=$((i+1)); done; printf '10 %%\\r90 %%\\r\\n\\033[31mred\\n'");
  EXPECT_GT(std::filesystem::file_size(output_), 1'000'000U);
  EXPECT_THAT(last_lines(output_, 3),
              ElementsAre(HasSubstr("line 19999 of"), "90 %", "\\x1B[31mred"));
  EXPECT_TRUE(last_lines(folder_.path() / "none", 3).empty());
}

/// A program's children end with it, whether it exits or is killed.
TEST_F(ChildProcessTest, EndsWithAllThatItStarted) {
  constexpr auto kPatience = std::chrono::seconds(20);
  const auto is_free_soon = [&] {
    const auto start = std::chrono::steady_clock::now();
    while (is_in_use(output_)) {
      if (std::chrono::steady_clock::now() - start > kPatience) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  };
  end_of("sleep 300 & exit 0");
  EXPECT_TRUE(is_free_soon());
  {
    const ChildProcess process(shell("trap '' TERM; sleep 300 & sleep 300"));
    EXPECT_TRUE(is_in_use(output_));
    EXPECT_THAT([&] { ChildProcess{shell("exit 0")}; },
                ThrowsMessage<InputError>(HasSubstr("still running")));
  }
  EXPECT_TRUE(is_free_soon());
  {
    // In its own session, and with a parent that has exited.
    const ChildProcess process(shell("setsid sleep 300 & (setsid sleep 300 &); sleep 300"));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_TRUE(is_free_soon());
  end_of("(setsid sleep 300 &); exit 0");
  EXPECT_TRUE(is_free_soon());
  ChildProcess asked(shell("sleep 300"));
  asked.ask_to_end();
  EXPECT_EQ(wait_for(asked).signal, SIGTERM);
}

}  // namespace
}  // namespace repose::base
