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

/// The program in a shell, with redirections as users write them.
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

  /// Runs `line`, in which "repose" is the program; the exit code is that of the last command.
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
  // Files are limited to 1 KiB: the JSON is larger, the CSV smaller.
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

TEST_F(OutputsOf, FilesOfOthersStay) {
  const std::string hints = "# Hints for heap.png\n";
  folder_.write("heap.png.repose.toml", hints);
  folder_.write("package.json", std::string("{\"name\": \"mine\"}\n"));
  folder_.write("mine.csv", std::string("sample,angle_deg\na,22\n"));
  folder_.write("page.html", std::string("<html><title>mine</title></html>\n"));
  folder_.write("camera.toml", hints);
  std::filesystem::copy(path("heap.png"), path("film.mp4"));
  const std::string study = text("study.toml");
  ASSERT_EQ(shell("repose measure heap.png --json own.txt").exit_code, 0);
  for (const std::string words :
       {"measure heap.png --csv heap.png.repose.toml", "measure heap.png --json package.json",
        "measure heap.png --csv mine.csv", "measure heap.png --report page.html",
        "measure heap.png --report new.jpg", "measure heap.png --summary package.json",
        "bench sliding angles.csv --json study.toml",
        "bench sliding angles.csv --json package.json",
        "regress runs.csv --response angle_deg --json package.json",
        "design sweep --factor a=0:1 --out mine.csv", "design sweep --factor a=0:1 --out runs.csv",
        "shape --size-mm 3,3,3 --out package.json", "verify --json package.json",
        "simulate drop study.toml --json package.json", "compare heap.png heap.png --json film.mp4",
        "measure heap.png --csv own.txt", "calibrate study.toml --json mine.csv"}) {
    const Finished refused = shell("repose " + words);
    EXPECT_EQ(refused.exit_code, 2) << words;
    EXPECT_THAT(refused.err, HasSubstr("Fix: ")) << words;
    EXPECT_THAT(refused.err, ::testing::AnyOf(HasSubstr("for another kind of file"),
                                              HasSubstr("is not what this option writes")))
        << words;
  }
  EXPECT_EQ(text("heap.png.repose.toml"), hints);
  EXPECT_EQ(text("package.json"), "{\"name\": \"mine\"}\n");
  EXPECT_EQ(text("mine.csv"), "sample,angle_deg\na,22\n");
  EXPECT_EQ(text("study.toml"), study);
  EXPECT_FALSE(exists("new.jpg"));
}

TEST_F(OutputsOf, ItsOwnFilesAreReplaced) {
  folder_.write("heap.png.repose.toml", std::string("pitch_deg = 0\n"));
  const std::string restitution = "--set contact.particle_wall.restitution=0.3 ";
  const std::string friction = "--set contact.particle_wall.sliding_friction=0.3";
  for (const std::string& words :
       Words{"measure heap.png --json a.json --csv a.csv --report a.html --summary s.json",
             "compare heap.png heap.png --json c.json --overlay c.png",
             "bench sliding angles.csv --json b.json",
             "regress runs.csv --response angle_deg --json r.json",
             "design sweep --factor a=0:1 --out d.csv", "board --out board.pdf",
             "board --out board.png",
             "shape --size-mm 3,3,3 --out clump.json --json shape.json --mesh m.stl",
             "shape --size-mm 3,3,3 --mesh m.glb",
             "simulate drop study.toml --json drop.json " + restitution + friction}) {
    for (int k = 0; k < 2; ++k) {
      const Finished done = shell("repose " + words);
      EXPECT_EQ(done.exit_code, 0) << words << done.err;
    }
  }
  // Results that the user has added are kept.
  folder_.write("d.csv", std::string("run,point,a,y\n1,level,0,3\n"));
  EXPECT_EQ(shell("repose design sweep --factor a=0:1 --out d.csv").exit_code, 2);
}

TEST_F(OutputsOf, NamesThatAreNoUtf8DoNotSpoilFiles) {
  const Finished done =
      shell("cp heap.png $'h\\xFF.png'; repose measure $'h\\xFF.png' --csv a.csv --report a.html");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* file : {"a.csv", "a.html"}) {
    EXPECT_THAT(text(file), AllOf(HasSubstr("h\uFFFD.png"), Not(HasSubstr("\xFF")))) << file;
  }
  const Finished refused = shell("repose new $'s\\xFF.toml'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("s\\xFF.toml: is not UTF-8"), HasSubstr("Fix: ")));
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
