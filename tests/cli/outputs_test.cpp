#include <string>

#include <gmock/gmock.h>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The program in a shell, whose redirections a user's are.
class OutputsOf : public CommandTest {
 protected:
  OutputsOf() : CommandTest({}) {
    HeapScene scene;
    scene.width = 600;
    scene.height = 400;
    static const vision::Picture heap = draw_heap(scene).picture;
    vision::write_picture(path("heap.png"), heap);
    folder_.write("angles.csv", std::string("angle_deg\n12\n13\n14\n"));
    folder_.write("runs.csv", std::string("a,angle_deg\n1,10\n2,12\n3,13\n4,17\n5,18\n"));
    folder_.write("study.toml", calibrate::test::kSphereStudy);
  }

  /// `line` with "repose" for the program; its last command's exit code.
  Finished shell(const std::string& line) const {
    folder_.write("line.sh", "repose() { '" + program().string() + "' \"$@\"; }\n" + line + "\n");
    return run_program("bash", folder_, {"line.sh"});
  }
};

TEST_F(OutputsOf, CommandsDoNotDependOnStandardError) {
  for (const char* lost : {"2>/dev/full", "2>&-"}) {
    const std::string words = std::string("heap.png none.png --json heap.json ") + lost;
    EXPECT_EQ(shell("repose measure " + words).exit_code, 2) << lost;
    EXPECT_EQ(json::parse(text("heap.json")).size(), 2U) << lost;
    EXPECT_EQ(shell(std::string("repose measured ") + lost).exit_code, 2) << lost;
    const Finished done =
        shell(std::string("repose calibrate study.toml --out study --json study.json ") + lost);
    EXPECT_EQ(done.exit_code, 0) << lost;
    EXPECT_THAT(done.out, HasSubstr("particle_wall.restitution")) << lost;
    EXPECT_EQ(text("study/result.json"), text("study.json")) << lost;
    for (const char* made : {"heap.json", "study.json"}) std::filesystem::remove(path(made));
    std::filesystem::remove_all(path("study"));
  }
}

TEST_F(OutputsOf, FilesAreWrittenBeforeStandardOutput) {
  for (const std::string command :
       {"measure heap.png", "compare heap.png heap.png", "bench sliding angles.csv",
        "regress runs.csv --response angle_deg", "shape --size-mm 3,3,3"}) {
    for (const std::string lost : {">/dev/full", ">&-", "| true"}) {
      const Finished done =
          shell("repose " + command + " --json x.json " + lost + "; exit ${PIPESTATUS[0]}");
      EXPECT_EQ(done.exit_code, 2) << command << lost;
      EXPECT_THAT(done.err, HasSubstr("standard output: cannot be written")) << command << lost;
      ASSERT_TRUE(exists("x.json")) << command << lost;
      EXPECT_FALSE(json::parse(text("x.json")).empty()) << command << lost;
      std::filesystem::remove(path("x.json"));
    }
  }
}

TEST_F(OutputsOf, AClosedStreamDoesNotBecomeAFile) {
  EXPECT_EQ(shell("repose measure heap.png --json x.json --csv x.csv >&- 2>&-").exit_code, 2);
  EXPECT_THAT(text("x.csv"), StartsWith("file,status"));
  EXPECT_EQ(json::parse(text("x.json")).size(), 1U);
}

TEST_F(OutputsOf, AFileThatCannotBeWrittenDoesNotKeepTheOthers) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer begins by writing a file of its own";
#endif
  // No file may grow beyond 1 KiB: the JSON is larger, the CSV smaller.
  const Finished full = shell(
      "ulimit -f 1; repose measure heap.png --json x.json --csv x.csv | cat; "
      "exit ${PIPESTATUS[0]}");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("x.json: cannot be written"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("x.json"));
  EXPECT_THAT(text("x.csv"), StartsWith("file,status"));
  EXPECT_THAT(full.out, HasSubstr("heap.png"));
}

TEST_F(OutputsOf, PicturesThatReposeDidNotMakeStay) {
  std::filesystem::create_directory(path("photos"));
  std::filesystem::copy(path("heap.png"), path("photos/heap.jpg"));
  folder_.write("photos/heap.png", std::string("somebody's photograph"));
  for (int k = 0; k < 2; ++k) {
    const Finished done = shell("repose measure photos/heap.jpg --overlay photos");
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_THAT(done.err, HasSubstr("its overlay is photos/heap-2.png"));
  }
  EXPECT_FALSE(exists("photos/heap-3.png")) << "its own pictures it replaces";
  const Finished refused = shell("repose compare heap.png heap.png --overlay photos/heap.png");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("not a picture written by repose"), HasSubstr("Fix: ")));
  EXPECT_EQ(text("photos/heap.png"), "somebody's photograph");
}

TEST_F(OutputsOf, WhatDoesNotFitIntoTheMemoryIsSaid) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need more memory than is allowed here";
#endif
  vision::Picture large{.width = 12000, .height = 9000, .bgr = {}};
  large.bgr.assign(std::size_t{3} * 12000 * 9000, 128);
  vision::write_picture(path("large.png"), large);
  for (const std::string command : {"measure large.png", "compare large.png large.png"}) {
    const Finished done = shell("ulimit -v 800000; repose " + command);
    EXPECT_EQ(done.exit_code, 2) << command;
    EXPECT_THAT(done.err, AllOf(HasSubstr("not enough memory"), HasSubstr("Fix: "),
                                HasSubstr("a smaller picture"), Not(HasSubstr("internal error"))))
        << command;
  }
}

TEST_F(OutputsOf, AnOptionThatIsGivenNothingIsRefused) {
  for (const std::string words : {"measure heap.png --json ''", "calibrate study.toml --out ''",
                                  "measure ''", "export study --to yade --out ''"}) {
    const Finished refused = shell("repose " + words);
    EXPECT_EQ(refused.exit_code, 2) << words;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("no value given"), HasSubstr("Fix: ")));
  }
}

TEST_F(OutputsOf, NamesDoNotControlTheTerminal) {
  const Finished done = shell("repose measure $'no\\033]0;x\\007.jpg' heap.png");
  EXPECT_THAT(done.err, AllOf(HasSubstr("no\\x1B]0;x\\x07.jpg"), Not(HasSubstr("\033"))));
  EXPECT_THAT(done.out, Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace repose::testing
