#include "base/csv.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace repose::base {
namespace {

TEST(Csv, CellsAreQuotedOnlyWhenTheyMustBe) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
}

TEST(Csv, NoCellIsAFormula) {
  EXPECT_EQ(csv_cell("=HYPERLINK(1).jpg"), "'=HYPERLINK(1).jpg");
  EXPECT_EQ(csv_cell("@SUM(1,2)"), "\"'@SUM(1,2)\"");
  EXPECT_EQ(csv_cell("-1+1"), "'-1+1");
  for (const char* number : {"-1.5", "+2", "-1e-5", "–"}) EXPECT_EQ(csv_cell(number), number);
}

TEST(Csv, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(csv_cell("a\xFF.jpg"), "a\uFFFD.jpg");
  EXPECT_EQ(csv_cell("=\xFF,"), "\"'=\uFFFD,\"");
}

TEST(Csv, ARowEndsItsLine) {
  EXPECT_EQ(csv_row(std::vector<std::string>{"a", "", "b,c"}), "a,,\"b,c\"\n");
}

}  // namespace
}  // namespace repose::base
