#include "calibrate/statistics/table/table.h"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string table_error(const std::string& text, const std::vector<std::string>& names = {}) {
  std::vector<NumberColumn> columns;
  for (const std::string& name : names) columns.push_back({.name = name});
  return error_of([&] { numbers_of(parse_table("runs.csv", text), columns); });
}

std::vector<double> column(const std::string& text, const std::string& name) {
  const NumberColumn wanted{.name = name};
  return numbers_of(parse_table("runs.csv", text), {&wanted, 1}).front();
}

/// The error of a single column "a" whose numbers must lie within limits.
std::string error_within(const std::string& text, double above, double below) {
  const NumberColumn wanted{"a", above, below};
  return error_of([&] { numbers_of(parse_table("runs.csv", text), {&wanted, 1}); });
}

TEST(Table, RowsKnowTheirLines) {
  const Table table = parse_table("runs.csv", "a,b\n1,2\n\n  \r\n3,4\n");
  EXPECT_THAT(table.columns, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].line, 2);
  EXPECT_EQ(table.rows[1].line, 5);
}

TEST(Table, SpreadsheetsHabitsAreUnderstood) {
  EXPECT_THAT(column("\xEF\xBB\xBF"
                     "a,b\r\n1,2\r\n3,4\r\n",
                     "a"),
              ElementsAre(1, 3));
  EXPECT_THAT(column("a;b\n1,5;2\n2.5;4\n", "a"), ElementsAre(1.5, 2.5));
  EXPECT_THAT(column("a\tb\n1,5\t2\n", "a"), ElementsAre(1.5));
  EXPECT_THAT(column("\"a, mm\",b\n\"1\",2\n+3,4", "a, mm"), ElementsAre(1, 3));
  EXPECT_THAT(column(" a , b\n 1e-3 , 2\n", "a"), ElementsAre(1e-3));
  EXPECT_EQ(parse_table("x", "a,b\n\"two\nlines \"\"here\"\"\",2\n").rows[0].cells[0],
            "two\nlines \"here\"");
}

TEST(Table, PointsThatMayPartThousandsAreRefusedBesideDecimalCommas) {
  EXPECT_THAT(table_error("a;b\n987,5;1\n1.012;2\n", {"a", "b"}),
              AllOf(HasSubstr("runs.csv:3: a is \"1.012\", which may mean thousands: line 2"),
                    HasSubstr("Fix: ")));
  EXPECT_THAT(table_error("a;b\n1;0,5\n-12.345.678;2\n", {"a", "b"}), HasSubstr("runs.csv:3"));
  EXPECT_THAT(column("a;b\n0.125;1,5\n12.5;2\n", "a"), ElementsAre(.125, 12.5));
}

TEST(Table, PointsThatMayPartThousandsAreReadByWhatIsPossible) {
  const std::string densities = "sample;a\nx;1.403\ny;1.398\n";
  EXPECT_THAT(error_within(densities, 0, 1e5),
              AllOf(HasSubstr("runs.csv:2: a is \"1.403\", which may mean 1403 as well as 1.403"),
                    HasSubstr("runs.csv:3: "), HasSubstr("Fix: write 1403 if it does")));
  EXPECT_THAT(error_within(densities, 10, 1e5), HasSubstr("which may mean 1403. Fix: "));
  EXPECT_EQ(error_within("sample;a\nx;22.125\ny;23.250\n", 0, 90), "");
  // Other numbers with an unambiguous decimal point settle it, even in another column.
  EXPECT_EQ(error_within("sample;a\nx;1.403\ny;1.4\n", 0, 1e5), "");
  EXPECT_EQ(table_error("a;b\n1.012;0.5\n", {"a", "b"}), "");
  EXPECT_EQ(error_within("sample,a\nx,1.403\n", 0, 1e5), "");
  EXPECT_THAT(table_error("a;b\n1.012;nut, small\n", {"a"}), HasSubstr("may mean 1012"));
}

TEST(Table, QuotedDecimalCommasAreRead) {
  EXPECT_THAT(column("b,a\nx,\"22,1\"\ny,\"1,403\"\n", "a"), ElementsAre(22.1, 1.403));
  EXPECT_THAT(table_error("b,a\nx,\"1,403\"\n", {"a"}), HasSubstr("may mean 1403"));
  EXPECT_THAT(table_error("b,a\nx,\"1,403.5\"\n", {"a"}), HasSubstr("points and commas"));
}

TEST(Table, ALineThatTellsTheSeparatorIsNoHeader) {
  EXPECT_THAT(column("sep=;\r\na;b\r\n1,5;2\r\n", "a"), ElementsAre(1.5));
  EXPECT_THAT(column("\xEF\xBB\xBF"
                     "sep=,\na,b\n1.5,2\n",
                     "a"),
              ElementsAre(1.5));
  EXPECT_EQ(parse_table("x", "sep=;\na;b\n1;2\n").rows[0].line, 3);
}

TEST(Table, ASingleColumnHasDecimalCommas) {
  EXPECT_THAT(column("a\n22,1\n22,9\n", "a"), ElementsAre(22.1, 22.9));
  EXPECT_THAT(column("a\n22.1\n", "a"), ElementsAre(22.1));
  EXPECT_THAT(table_error("a\n1,22\n2,23\n"),
              AllOf(HasSubstr("runs.csv:2: the header names one column"), HasSubstr("Fix: ")));
}

TEST(Table, WhatIsEmptyIsPassedOver) {
  const Table table = parse_table("x", "a;b;;\n1;2;;\n;;;\n3;4\n;\n");
  EXPECT_THAT(table.columns, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
  EXPECT_THAT(table_error("a;;\n1;2;\n"), HasSubstr("column 2 has no name"));
}

TEST(Table, AnotherKindOfFileIsNamed) {
  EXPECT_THAT(table_error("PK\x03\x04 rest"), HasSubstr("own file (.xlsx or .ods)"));
  EXPECT_THAT(table_error("\xD0\xCF\x11\xE0 rest"), HasSubstr("own file (.xls)"));
  EXPECT_THAT(table_error("\xFF\xFE"
                          "a"),
              AllOf(HasSubstr("UTF-16"), HasSubstr("CSV UTF-8")));
}

TEST(Table, OfManyErrorsTheFirstTenAreListed) {
  std::string cells = "a,b\n", ragged = "a,b\n";
  for (int row = 0; row < 1000; ++row) {
    cells += "x,1\n";
    ragged += "1\n";
  }
  for (const std::string& error : {table_error(cells, {"a", "b"}), table_error(ragged)}) {
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 10);
    EXPECT_THAT(error, HasSubstr("\nand 990 more of this kind"));
  }
}

TEST(Table, BytesThatAreNoLettersAreRefused) {
  EXPECT_THAT(table_error(std::string("a,b\n1\0x,2\n", 10), {"a"}),
              AllOf(HasSubstr("runs.csv:2: holds a byte that is no letter (number 0)"),
                    HasSubstr("CSV UTF-8")));
  EXPECT_THAT(table_error("a,b\n\x1b[2J,2\n"), HasSubstr("number 27"));
}

TEST(Table, EveryRaggedLineIsNamed) {
  EXPECT_THAT(table_error("a,b\n1,2\n1\n1,2,3\n"),
              AllOf(HasSubstr("runs.csv:3: the row has 1 cells, the header 2"),
                    HasSubstr("runs.csv:4: the row has 3 cells")));
}

TEST(Table, EveryCellThatIsNoNumberIsNamed) {
  const std::string error =
      table_error("a,b\n1,nan\nx,2\n,3\n4,inf\n1e999,5\n1 2,6\n", {"a", "b", "c"});
  for (const char* part :
       {"runs.csv:2: b is \"nan\"", "runs.csv:3: a is \"x\"", "runs.csv:4: a is \"\"",
        "runs.csv:5: b is \"inf\"", "runs.csv:6: a is \"1e999\"", "runs.csv:7: a is \"1 2\"",
        "has no column c"}) {
    EXPECT_THAT(error, HasSubstr(part));
  }
}

TEST(Table, AMistypedColumnIsGuessed) {
  EXPECT_THAT(table_error("angle_deg,mu\n1,2\n", {"angel_deg"}),
              HasSubstr("Did you mean angle_deg?"));
}

TEST(Table, WhatIsNoTableIsRefused) {
  EXPECT_THAT(table_error(""), HasSubstr("runs.csv: is empty"));
  EXPECT_THAT(table_error("\n \n"), HasSubstr("runs.csv: is empty"));
  EXPECT_THAT(table_error("a,b\n"), HasSubstr("no rows"));
  EXPECT_THAT(table_error("a,,a\n1,2,3\n"),
              AllOf(HasSubstr("column 2 has no name"), HasSubstr("two columns are called a")));
  EXPECT_THAT(table_error("a,b\n\"1,2\n"), HasSubstr("quotation mark"));
  EXPECT_THAT(table_error("a,b\n1\"2,3\n"), HasSubstr("runs.csv:2: a quotation mark"));
}

TEST(Table, FilesThatCannotBeReadAreNamed) {
  const testing::TemporaryFolder folder;
  for (const auto& file : {folder.path(), folder.path() / "missing.csv"}) {
    EXPECT_THAT(error_of([&] { read_table(file); }),
                AllOf(HasSubstr(file.string()), HasSubstr("Fix: ")));
  }
  EXPECT_EQ(read_table(folder.write("a.csv", std::string("x\n1\n"))).rows.size(), 1U);
}

}  // namespace
}  // namespace repose::calibrate
