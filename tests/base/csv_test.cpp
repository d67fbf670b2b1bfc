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

TEST(Csv, ARowEndsItsLine) {
  EXPECT_EQ(csv_row(std::vector<std::string>{"a", "", "b,c"}), "a,,\"b,c\"\n");
}

}  // namespace
}  // namespace repose::base
