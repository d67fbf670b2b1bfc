#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/calibrate/made_up_result.h"
#include "tests/cli/command_test.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

class ReportCommand : public CommandTest {
 protected:
  ReportCommand() : CommandTest({"report"}) {
    std::filesystem::create_directory(folder_.path() / "study");
    folder_.write("study/result.json", to_json(calibrate::test::joint_result()));
  }
};

TEST_F(ReportCommand, LeavesPageAndTablesInTheFolder) {
  const Finished done = run({"study"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, "study/report.html\n");
  EXPECT_THAT(done.err, IsEmpty());
  EXPECT_THAT(text("study/report.html"), StartsWith("<!doctype html>"));
  EXPECT_THAT(text("study/report.html"), EndsWith("</html>\n"));
  EXPECT_THAT(text("study/tables/coefficients.csv"), HasSubstr("0.4,0.35,0.45"));
}

TEST_F(ReportCommand, PlacesCanBeChosen) {
  const Finished done = run({"study", "--out", "page.html", "--tables", "numbers"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(exists("page.html"));
  EXPECT_TRUE(exists("numbers/coefficients.csv"));
  EXPECT_FALSE(exists("study/report.html"));
  EXPECT_FALSE(exists("study/tables"));
  EXPECT_EQ(run({"study", "--out", "alone.html", "--tables", "none"}).exit_code, 0);
  EXPECT_FALSE(exists("none"));
  EXPECT_EQ(text("alone.html"), text("page.html"));
}

TEST_F(ReportCommand, FoldersWithoutAStudyAreRefused) {
  const Finished none = run({"nowhere"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("nowhere: there is no such folder"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("nowhere"));
  const Finished unnamed = run({});
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.err, HasSubstr("Fix: repose report FOLDER"));
}

TEST_F(ReportCommand, DamagedResultsLeaveTheEarlierPage) {
  const std::string earlier = "<meta name=\"generator\" content=\"repose 0.1.0\">";
  folder_.write("study/report.html", earlier);
  folder_.write("study/result.json", std::string("{\"method\""));
  const Finished done = run({"study"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, HasSubstr("result.json: is not a result"));
  EXPECT_EQ(text("study/report.html"), earlier);
}

TEST_F(ReportCommand, PlacesThatCannotBeWrittenAreSaidFirst) {
  folder_.write("file", std::string("no folder"));
  const Finished tables = run({"study", "--tables", "file"});
  EXPECT_EQ(tables.exit_code, 2);
  EXPECT_THAT(tables.err, AllOf(HasSubstr("--tables file"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("study/report.html"));
  EXPECT_EQ(run({"study", "--out", "no/folder/page.html"}).exit_code, 2);
}

class MeasureReportCommand : public ::testing::Test {
 protected:
  MeasureReportCommand() {
    HeapScene scene;
    scene.width = 600;
    scene.height = 400;
    vision::write_picture(folder_.path() / "heap.png", draw_heap(scene).picture);
    folder_.write("no_picture.png", std::string("text"));
  }

  TemporaryFolder folder_;
};

TEST_F(MeasureReportCommand, WritesAPageOfAllPictures) {
  const Finished done =
      run_repose(folder_, {"measure", "heap.png", "no_picture.png", "--report", "page.html"});
  EXPECT_EQ(done.exit_code, 2);  // as without a report: a picture could not be read
  const std::string page = text_of(folder_.path() / "page.html");
  EXPECT_THAT(page, AllOf(HasSubstr("heap.png"), HasSubstr("no_picture.png"),
                          HasSubstr("data:image/jpeg;base64,"), HasSubstr("not read")));
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("heap.png", "no_picture.png", "page.html"));
}

TEST_F(MeasureReportCommand, IsNotWrittenOverAPictureNorToATerminal) {
  for (const char* place : {"heap.png", "-"}) {
    const Finished done = run_repose(folder_, {"measure", "heap.png", "--report", place});
    EXPECT_EQ(done.exit_code, 2) << place;
    EXPECT_THAT(done.err, AllOf(HasSubstr("--report"), HasSubstr("Fix: ")));
    EXPECT_THAT(done.out, IsEmpty());
  }
}

}  // namespace
}  // namespace repose::testing
