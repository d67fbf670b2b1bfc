// Tables of runs with oddities: slips, points as thousands separators, thousands of columns.
#include <filesystem>
#include <sstream>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "calibrate/runs/odd_readings.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "tests/calibrate/made_up_table.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class OddTables : public ::testing::Test {
 protected:
  TableStudy study(const std::string& text) const {
    return read_table_study(folder_.write("study.toml", text));
  }
  TableRuns runs(const TableStudy& of, const std::string& text) const {
    return read_table_runs(of, {folder_.write("runs.csv", text)});
  }

  testing::TemporaryFolder folder_;
};

using OddReadings = OddTables;

/// The rows with one cell replaced.
std::string with_cell(const std::string& rows, int line, int column, const std::string& value) {
  std::istringstream lines(rows);
  std::string text, row;
  for (int at = 1; std::getline(lines, row); ++at) {
    std::istringstream cells(row);
    std::string cell, changed;
    for (int place = 0; std::getline(cells, cell, ','); ++place) {
      changed += (place == 0 ? "" : ",") + (at == line && place == column ? value : cell);
    }
    text += changed + '\n';
  }
  return text;
}

TEST_F(OddReadings, ASlipIsNamedWithItsRow) {
  const TableStudy of = study(test::made_up_study(test::kMeasuredDensity));
  constexpr int kLine = 9, kAngle = 3, kDensity = 5;
  const std::string rows = test::made_up_rows({.rows = 24});
  const auto odd = [&](const std::string& text) {
    const TableRuns table = runs(of, text);
    return odd_readings(problem_of(of, table), table);
  };
  EXPECT_THAT(odd(rows), IsEmpty());
  const auto slip = odd(with_cell(rows, kLine, kAngle, "71.6"));
  ASSERT_EQ(slip.size(), 1U);
  EXPECT_THAT(slip[0].text(), AllOf(HasSubstr("angle = 71.6 in "), HasSubstr("runs.csv:9, where")));
  EXPECT_LT(slip[0].expected.high, 40);
  const std::string two = with_cell(with_cell(rows, kLine, kDensity, "8123"), 15, kDensity, "7987");
  EXPECT_EQ(odd(two).size(), 2U) << "they do not hide each other";
  const auto joint = std::get<JointResult>(fit_table(of, runs(of, two)).found);
  EXPECT_THAT(joint.warnings, Contains(AllOf(HasSubstr("density = 8123 in "), HasSubstr(":9, "),
                                             HasSubstr("It counts"))));
}

/// A spreadsheet with points as thousands separators, in a table that otherwise has decimal points.
TEST_F(OddReadings, APointThatMayPartThousandsIsNamed) {
  const TableStudy of = study(test::made_up_study(test::kMeasuredDensity));
  constexpr int kDensity = 5;
  std::string rows = test::made_up_rows({.rows = 24});
  EXPECT_THAT(runs(of, rows).notes, Not(Contains(HasSubstr("parts thousands"))));
  for (const int line : {4, 9, 13, 17}) rows = with_cell(rows, line, kDensity, "1.012");
  EXPECT_THAT(runs(of, rows).notes,
              Contains(AllOf(HasSubstr("density is 1.012 in line 4, 1.012 in line 9"),
                             HasSubstr("where a point parts thousands, write 1012"))));
  // A value not close to a thousandth of the others, or like all of them, is just a number.
  EXPECT_THAT(runs(of, with_cell(test::made_up_rows(), 4, kDensity, "9.125")).notes,
              Not(Contains(HasSubstr("parts thousands"))));
}

TEST_F(OddTables, ManyColumnsAreNotAllNamed) {
  std::string header = "sliding,rolling,restitution,angle", row = "0.4,0.1,0.5,20";
  for (int k = 0; k < 3000; ++k) {
    header += fmt::format(",note_{}", k);
    row += ",x";
  }
  const TableRuns table = runs(study(test::made_up_study()), header + '\n' + row + '\n');
  EXPECT_THAT(table.notes,
              Contains(AllOf(HasSubstr("not used: note_0, note_1"), HasSubstr("and 2990 more"))));
}

TEST_F(OddTables, FailuresAtOnePlaceAreNoCopies) {
  const TableStudy of =
      study("[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 3, sd = 1, n = 4 }\n");
  const TableRuns table = runs(
      of, "x,y,status\n0,1,ok\n0,1.1,ok\n0.5,,failed\n0.5,,failed\n0.5,7,failed\n1,5,ok\n1,5,ok\n");
  EXPECT_EQ(table.failed, 3);
  EXPECT_EQ(table.left_out, 1) << "the last row";
  EXPECT_THAT(table.ends, ::testing::ElementsAre(RowEnd::reading, RowEnd::reading, RowEnd::failed,
                                                 RowEnd::failed, RowEnd::failed, RowEnd::reading));
}

TEST_F(OddTables, TablesOfOneNameAreToldApart) {
  const TableStudy of = study(test::made_up_study());
  std::filesystem::create_directories(folder_.path() / "a/runs");
  const auto one = folder_.write("runs.csv", test::made_up_rows({.rows = 12}));
  const auto other = folder_.write("a/runs/runs.csv", test::made_up_rows({.rows = 14}));
  const TableRuns both = read_table_runs(of, {one, other});
  EXPECT_EQ(both.files[1], "runs/runs.csv");
  EXPECT_NE(both.files[0], both.files[1]);
  EXPECT_EQ(read_table_runs(of, {other}).files[0], "runs.csv");
}

}  // namespace
}  // namespace repose::calibrate
