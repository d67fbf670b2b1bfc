#include "base/toml_nesting.h"

#include <string>

#include <gmock/gmock.h>

namespace repose::base {
namespace {

std::string key(int points) {
  std::string text = "a";
  for (int k = 0; k < points; ++k) text += " . \"b.\"";
  return text;
}

TEST(DeepKey, IsFoundByItsLine) {
  EXPECT_EQ(line_of_deep_key("x = 1\n\n" + key(9) + " = 2\n"), 3);
  EXPECT_EQ(line_of_deep_key("x = 1\n[" + key(9) + "]\n"), 2);
  EXPECT_EQ(line_of_deep_key("x = { " + key(9) + " = 1 }"), 1);
  EXPECT_EQ(line_of_deep_key("x = \"\"\"\n\n\"\"\"\n'\\' = 1\n" + key(20000) + " = 2"), 5);
  EXPECT_EQ(line_of_deep_key("\"#\"" + key(9).substr(1) + " = 1"), 1);
}

TEST(DeepKey, OtherPointsAreNone) {
  EXPECT_FALSE(line_of_deep_key(key(8) + " = 1\n" + key(8) + " = 2\n"));
  EXPECT_FALSE(line_of_deep_key("# ....................\nx = \"....................\"\n"));
  EXPECT_FALSE(line_of_deep_key("x = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5]\n"));
  EXPECT_FALSE(line_of_deep_key("x = '..........'\ny = \"\\\"..........\"\n"));
  EXPECT_FALSE(line_of_deep_key("x = \"\"\"\n..........\n..........\"\"\"\n"));
  EXPECT_FALSE(line_of_deep_key("\"not closed\n"));
  EXPECT_FALSE(line_of_deep_key(""));
}

}  // namespace
}  // namespace repose::base
